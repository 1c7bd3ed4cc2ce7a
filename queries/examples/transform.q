# Moving, turning, mirroring and measuring. Run it with:   algebra3d --db transform.db transform.q
let Origin = makePoint3D(0, 0, 0);
let Z = makeVector3D(0, 0, 1);
let Beam = createCube(Origin, makePoint3D(4, 2, 1));

query volume(Beam);
query area(Beam);
query centroid(Beam);
query bbox(Beam);

# A vector in brackets, written as a constant or made.
query bbox(Beam translate[[const vector3d value (10 0 0)]]);
query bbox(Beam translate[makeVector3D(10, 0, 0)]);

# A quarter turn about an axis is exact; four of them change nothing.
query bbox(Beam rotate[Origin, Z, 90]);
query Beam rotate[Origin, Z, 90] rotate[Origin, Z, 90] rotate[Origin, Z, 90] rotate[Origin, Z, 90] = Beam;

# A mirrored solid keeps its outside, and so its volume.
query volume(Beam mirror[[const plane3d value (0 1 1 0)]]);
query volume(Beam scaleDir[Origin, makeVector3D(-1, 2, 3)]);

# No factor may be zero: the result is undefined, and a note says why.
query Beam scale[Origin, 0];

# Coordinates may be fractions. They are kept as they are, and numbers made of them are rounded once.
let Third = [const point3d value (1/3 0 0)];
query Third;
query getx(Third);
query Third = makePoint3D(0.3333333333333333, 0, 0);

# A function is an object, too.
let turned = fun(s: volume3d, degrees: real) s rotate[centroid(s), Z, degrees];
query centroid(turned(Beam, 30));
query intstream(0, 3) transformstream extend[Turned: turned(Beam, .Elem * 90)] extend[Box: bbox(.Turned)] project[Elem, Box]
  consume;

# A solid in two parts, taken apart.
let Pair = [const volume3d value (
  ((0 0 0) (0 1 0) (1 0 0)) ((0 0 0) (1 0 0) (0 0 1)) ((0 0 0) (0 0 1) (0 1 0)) ((1 0 0) (0 1 0) (0 0 1))
  ((5 0 0) (5 2 0) (7 0 0)) ((5 0 0) (7 0 0) (5 0 2)) ((5 0 0) (5 0 2) (5 2 0)) ((7 0 0) (5 2 0) (5 0 2)))];
query components(Pair) transformstream projectextend[; Volume: volume(.Elem), Centre: centroid(.Elem)] consume;
