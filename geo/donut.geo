// A ring whose hole is off its centre: the fronts from outside and inside meet first where the ring is thin.
DefineConstant[ outer = 1, inner = 0.45, shift = 0.4, size = 0.07 ];

Point(1) = {0, 0, 0};
Point(2) = {outer, 0, 0, size};
Point(3) = {0, outer, 0, size};
Point(4) = {-outer, 0, 0, size};
Point(5) = {0, -outer, 0, size};
Point(6) = {shift, 0, 0};
Point(7) = {shift + inner, 0, 0, size / 2};
Point(8) = {shift, inner, 0, size};
Point(9) = {shift - inner, 0, 0, size};
Point(10) = {shift, -inner, 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Circle(5) = {7, 6, 8};
Circle(6) = {8, 6, 9};
Circle(7) = {9, 6, 10};
Circle(8) = {10, 6, 7};
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};

Plane Surface(1) = {1, 2};
Physical Curve("outside") = {1:4};
Physical Curve("hole") = {5:8};
Physical Surface("ring") = {1};
