# Two storms that move and change their shape: where and when did both rain?
# Run it with:   algebra3d --db storms.db storms.q
#
# Each storm is a moving region: units of time, and in each unit corners that move linearly, written (x y at the start,
# x y at the end), in kilometres. The first one grows out of a point and travels to the north-east; at noon its eye opens.
let Anna = [const mregion value (
  (("2011-07-08-06:00" "2011-07-08-12:00" TRUE FALSE)
    ((((10 10 20 20) (10 10 60 20) (10 10 60 60) (10 10 20 60)))))
  (("2011-07-08-12:00" "2011-07-08-18:00" TRUE TRUE)
    ((((20 20 50 40) (60 20 90 40) (60 60 90 80) (20 60 50 80))
      ((40 40 65 55) (40 40 75 55) (40 40 75 65) (40 40 65 65))))))];

# The second one comes from the east and dies away over the land.
let Bert = [const mregion value (
  (("2011-07-08-09:00" "2011-07-08-15:00" TRUE TRUE)
    ((((90 25 20 30) (120 40 35 37.5) (110 65 30 50) (90 55 20 45))))))];

# Time becomes height: 240 units a day, so ten an hour, from the first storm's start.
let AnnaRain = mregion2volume(Anna, 240);
query volume(AnnaRain);

# Each solid starts at height 0 with its own first unit; Bert's begins three hours later.
let BertRain = mregion2volume(Bert, 240) translate[makeVector3D(0, 0, 30)];

# Where and when both rained, how much that is, and for how long: ten units of height are an hour.
let BothRain = intersection(AnnaRain, BertRain);
query volume(BothRain);
query bbox(BothRain);

# At noon, six hours after Anna began: the region in which it rained out of both, from space-time and from the storms.
# The corners of both keep the directions of their segments, so the two are equal, exactly.
query slice(BothRain, 60);
query slice(BothRain, 60) =
  intersection(atinstant(Anna, [const instant value "2011-07-08-12:00"]),
               atinstant(Bert, [const instant value "2011-07-08-12:00"]));

# Everything that got wet, and what got wet twice.
query area(projectXY(AnnaRain union BertRain));
query area(projectXY(BothRain));

# For other programs.
query BothRain exportSTL["both storms", 'both_storms.stl', TRUE];
query BothRain exportOBJ["both storms", 'both_storms.obj'];
