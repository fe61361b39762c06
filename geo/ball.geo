// A ball sewn like an old football, seen from the front: a disc whose seams are shared curves, five-sided in the middle.
DefineConstant[ radius = 1, patch = 0.42, size = 0.06 ];

Point(1) = {0, 0, 0};
For i In {0:4}
  a = Pi / 2 + 2 * Pi * i / 5;
  Point(10 + i) = {patch * Cos(a), patch * Sin(a), 0, size};
  Point(20 + i) = {radius * Cos(a), radius * Sin(a), 0, size};
EndFor
For i In {0:4}
  j = (i + 1) % 5;
  Line(10 + i) = {10 + i, 10 + j};        // the patch in the middle
  Line(20 + i) = {10 + i, 20 + i};        // a seam outwards
  Circle(30 + i) = {20 + i, 1, 20 + j};   // the rim
EndFor
Curve Loop(1) = {10:14};
Plane Surface(1) = {1};
For i In {0:4}
  j = (i + 1) % 5;
  Curve Loop(2 + i) = {20 + i, 30 + i, -(20 + j), -(10 + i)};
  Plane Surface(2 + i) = {2 + i};
EndFor

Physical Curve("seams") = {10:14, 20:24};
Physical Curve("rim") = {30:34};
Physical Surface("black") = {1};
Physical Surface("white") = {2:6};
