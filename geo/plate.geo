// Plate with a hole: the first thing to try, and the standard problem of stress concentration.
// Lengths in metres; change them with -setnumber, for example -setnumber hole 0.3.
DefineConstant[ width = 2, height = 1, hole = 0.2, size = 0.045 ];

Point(1) = {-width / 2, -height / 2, 0, size};
Point(2) = {width / 2, -height / 2, 0, size};
Point(3) = {width / 2, height / 2, 0, size};
Point(4) = {-width / 2, height / 2, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};

Point(5) = {0, 0, 0};
Point(6) = {hole, 0, 0, size / 2};
Point(7) = {0, hole, 0, size / 2};
Point(8) = {-hole, 0, 0, size / 2};
Point(9) = {0, -hole, 0, size / 2};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 8};
Circle(7) = {8, 5, 9};
Circle(8) = {9, 5, 6};
Curve Loop(2) = {5:8};

Plane Surface(1) = {1, 2};
Physical Curve("clamped") = {4};
Physical Curve("pulled") = {2};
Physical Curve("hole") = {5:8};
Physical Surface("plate") = {1};
