# An index, window queries, nearest neighbours and a spatial join on 10,000 generated solids.
# Run it with:   algebra3d --db join.db spatial_join.q
#
# Box No stands on a grid of step 3: column No mod 25, row No div 25 mod 20, level No div 500.
let Parts = intstream(0, 9999) transformstream projectextend[; No: .Elem, Solid: createCube(
    makePoint3D((.Elem mod 25) * 3, (.Elem div 25 mod 20) * 3, (.Elem div 500) * 3),
    makePoint3D((.Elem mod 25) * 3 + 1 + .Elem mod 3, (.Elem div 25 mod 20) * 3 + 2, (.Elem div 500) * 3 + 2))] consume;
query Parts count;

# An R-tree over the boxes of the solids. It is stored as a definition and follows every change of Parts.
let Parts_Solid = Parts creatertree[Solid];

# The solids whose boxes meet a window: by the index, by reading every box, and that both are the same.
let Window = rectangle3(10, 20, 10, 20, 10, 20);
query Parts_Solid Parts windowintersects[Window] count;
query Parts feed filter[bbox(.Solid) intersects Window] count;
query Parts_Solid Parts windowintersects[Window] project[No] {a}
  Parts feed filter[bbox(.Solid) intersects Window] project[No] {b} hashjoin[No_a, No_b] count;

# The five solids nearest to a point.
query Parts_Solid Parts distancescan[makePoint3D(30.5, 30.5, 30.5), 5]
  projectextend[No; Distance: bboxDistance(.Solid, bbox(makePoint3D(30.5, 30.5, 30.5)))] consume;

# Pairs of solids whose boxes meet. itSpatialJoin builds its own R-tree over the first stream.
let Tools = intstream(1, 1000) transformstream projectextend[; Id: .Elem,
    Body: createSphere(makePoint3D((.Elem * 7) mod 75, (.Elem * 11) mod 60, (.Elem * 13) mod 60), 1, 8)] consume;
query Parts feed Tools feed itSpatialJoin[Solid, Body] count;

# The same pairs, by asking the stored index once for each tool.
query Tools feed loopjoin[fun(t: TUPLE) Parts_Solid Parts windowintersects[attr(t, Body)]] count;

# On fewer tools the join equals the nested loop, which compares every pair.
query Parts feed Tools feed head[20] itSpatialJoin[Solid, Body] count
  = Parts feed Tools feed head[20] symmjoin[bbox(.Solid) intersects bbox(..Body)] count;

# The index follows a deletion.
query Parts feed filter[.No mod 2 = 0] Parts deletesearch count;
query Parts_Solid Parts windowintersects[Window] count = Parts feed filter[bbox(.Solid) intersects Window] count;
