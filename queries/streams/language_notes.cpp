// The notes that the query language adds to the descriptions of operators over values, which do not mention a host.
#include "queries/streams/all.h"

namespace queries {

void register_language_notes(algebra3d::Registry& registry) {
  for (const char* name : {"sum", "avg", "min", "max", "union_aggr", "intersection_aggr", "extent"})
    registry.add_language_note(name, std::string("In `groupby`, for each group: `group feed ") + name + "[A]`.");
  for (const char* name : {"=", "#"})
    registry.add_language_note(
        name, "Nested relations are equal if they have the same tuples as often, whatever their order.");
  for (const char* name : {"<", "<=", ">", ">="})
    registry.add_language_note(
        name,
        "Of two nested relations the one with fewer tuples comes first, then the one whose first "
        "different tuple, in ascending order, is smaller.");
  registry.add_language_note("makeRegion", "The points come in the order of the stream.");
  registry.add_language_note("repairReport",
                             "The report as a relation: `repairReport('part.stl') consume`. Without a single row, "
                             "`repairReport('part.stl') count` is 0.");
  registry.add_language_note("importGeoJSON", "As a relation: `importGeoJSON('parks.geojson') consume`.");
  registry.add_language_note("components",
                             "One tuple for each part: `Parts feed extendstream[P: components(.Solid)]`.");
  registry.add_language_note("intstream", "As tuples with the attribute Elem: `intstream(1, 5) transformstream`.");
  registry.add_language_note("getDirectory", "To import files into a relation see also `algebra3d import`.");
}

}  // namespace queries
