# Five questions about imported parts, answered from the faces, edges and vertices of their meshes. Run it from the root of
# the source tree with:   algebra3d --db elements.db queries/examples/mesh_elements.q
#
# Three parts are files of the tree. Two more are written first, as another program would write them.
let Plate = createCube(makePoint3D(0, 0, 0), makePoint3D(60, 40, 4));
let Rib = createCube(makePoint3D(0, 18, 4), makePoint3D(60, 22, 30));
let Shelf = createCube(makePoint3D(0, 5, 30), makePoint3D(60, 35, 34));
let Bores = createCylinder(makePoint3D(10, 8, -1), 3, 6, 24) union createCylinder(makePoint3D(50, 32, -1), 3, 6, 24);
query (((Plate union Rib) union Shelf) minus Bores) exportSTL["bracket", 'bracket.stl', FALSE];
query createCylinder(makePoint3D(0, 0, 0), 5, 20, 16) exportSTL["pin", 'pin.stl', FALSE];
let Files = [const rel(tuple([Name: string, File: text])) value (("bracket" 'bracket.stl') ("pin" 'pin.stl')
    ("two bars" 'tests/regression/data/two_solids.stl') ("hollow cube" 'tests/regression/data/cube_with_cavity.stl'))];
let Parts = Files feed projectextend[Name; Solid: importSTL(.File)] consume;
query Parts inserttuple["profile", importOFF('tests/regression/data/l_prism.off')] count;
let Up = makeVector3D(0, 0, 1);

# 1. Which area overhangs when a part is printed upwards? Faces that look down by more than 45 degrees, without those on the
# ground.
query Parts feed extend[Ground: minD(bbox(.Solid), 3)]
  projectextend[Name; Overhang: fun(part: TUPLE) faces(attr(part, Solid))
    filter[fun(face: TUPLE) (dot(attr(face, Normal), Up) < -0.7072) and (getz(attr(face, Centroid)) > attr(part, Ground))]
    sum[Area]] consume;

# 2. How long are the sharp edges of a part, which have to be deburred, and how long the inner corners?
query Parts feed projectextend[Name; Sharp: edges(.Solid) filter[.Angle > 30] sum[Length],
  Inner: edges(.Solid) filter[.Angle < -30] sum[Length]] consume;

# 3. How many holes go through each body? Bores count, cavities do not.
query Parts feed projectextendstream[Name; Body: components(.Solid)] projectextend[Name; Faces: size(.Body),
  Holes: genus(.Body)] consume;

# 4. Where is a surface open? Its loops, and the edges of one with their ends.
let Open = importSurface('tests/regression/data/repair_open_box.stl');
query boundaryLoops(Open) consume;
query edges(Open) filter[.Boundary] vertices(Open) {a} hashjoin[Start, Id_a] vertices(Open) {b} hashjoin[End, Id_b]
  projectextend[Id, Length; From: .Position_a, To: .Position_b] sortby[Id] consume;

# 5. Which triangles are badly shaped? The quality is 1 for three equal edges and 0 for a line: the area by the sum of the
# squared edges.
let Bracket = Parts feed filter[.Name = "bracket"] extract[Solid];
query faces(Bracket) projectextend[Id, Area; Quality: 4 * sqrt(3.0) * .Area /
    (faceEdges(Bracket, .Id) extend[Square: .Length * .Length] sum[Square])] sortby[Quality] head[5] consume;
