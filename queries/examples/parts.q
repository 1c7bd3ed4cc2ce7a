# From STL files to a stored relation. Run it with:   algebra3d --db parts.db parts.q
#
# Three solids are written to files first, so that the script has something to import. Files are named from the
# folder in which the program was started.
query createCube(makePoint3D(0, 0, 0), makePoint3D(20, 10, 5)) exportSTL["plate", 'plate.stl', TRUE];
query createCylinder(makePoint3D(10, 5, 5), 3, 40, 24) exportSTL["shaft", 'shaft.stl', TRUE];
query createSphere(makePoint3D(10, 5, 50), 6, 24) exportSTL["knob", 'knob.stl', FALSE];

# Every *.stl file of the folder and below becomes a tuple. What is not a valid solid becomes undefined, with a note that
# says why, and stops nothing.
let Parts = getDirectory('.', '*.stl') transformstream projectextend[; Name: .Elem, Solid: importSTL(.Elem)] consume;

query Parts feed projectextend[Name; Triangles: size(.Solid), Volume: volume(.Solid), Box: bbox(.Solid)] sortby[Name]
  consume;

# Undefined solids have no volume, and a comparison with undefined keeps nothing.
query Parts feed filter[volume(.Solid) > 900] count;

# Aggregates, over all and by group.
query Parts feed extend[V: volume(.Solid)] sum[V];
query Parts feed extend[Large: volume(.Solid) > 900] sortby[Large] groupby[Large; Number: group count,
  Triangles: group feed extend[N: size(.Solid)] sum[N]] consume;

# Relations grow and shrink.
query Parts inserttuple['washer', createCylinder(makePoint3D(10, 5, 45), 5, 1, 24)] count;
query Parts feed filter[.Name contains "knob"] Parts deletesearch count;
query Parts feed project[Name] sortby[Name] consume;
