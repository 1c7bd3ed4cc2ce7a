# The tour of the README: ten commands on solids that the program makes itself.
let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2));
let Turned = Cube rotate[makePoint3D(1, 1, 1), makeVector3D(1, 2, 3), 30.0];
query volume(Turned);
query ((Cube minus Turned) union intersection(Cube, Turned)) = Cube;
query bbox(Cube mirror[makePlane3D(makePoint3D(0, 0, 0), makeVector3D(1, 1, 0))]);
let Balls = intstream(1, 1000) transformstream extend[Ball: createSphere(makePoint3D(.Elem, .Elem mod 7, 0), 0.8, 16)] consume;
let Balls_Ball = Balls creatertree[Ball];
query Balls_Ball Balls windowintersects[rectangle3(10, 12, 0, 9, -1, 1)] projectextend[Elem; Volume: volume(.Ball)] head[3] consume;
query Balls feed {a} Balls feed {b} itSpatialJoin[Ball_a, Ball_b] filter[.Elem_a < .Elem_b] count;
query [const volume3d value (((0 0 0) (1 0 0) (0 1 0)))];
query Cube exportSTL["cube", 'cube.stl', TRUE];
