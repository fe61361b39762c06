// A rectangle, where the best mesh is known: every quad a square, no irregular node.
DefineConstant[ width = 2, height = 1, size = 0.05 ];

Point(1) = {0, 0, 0, size};
Point(2) = {width, 0, 0, size};
Point(3) = {width, height, 0, size};
Point(4) = {0, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("rectangle") = {1};
