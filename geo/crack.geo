// Plate with an embedded kinked crack and embedded points (sensors): edges and nodes inside the surface that have to stay.
DefineConstant[ size = 0.05, tip = 0.012 ];

Point(1) = {0, 0, 0, size};
Point(2) = {2, 0, 0, size};
Point(3) = {2, 1.2, 0, size};
Point(4) = {0, 1.2, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Point(5) = {0, 0.6, 0, size}; // mouth of the crack
Line(4) = {4, 5};
Line(8) = {5, 1};
Curve Loop(1) = {1:4, 8};
Plane Surface(1) = {1};

// The first crack starts at the edge, the second lies inside.
Point(6) = {0.5, 0.62, 0, size / 2};
Point(7) = {0.8, 0.75, 0, tip};
Point(8) = {1.1, 0.35, 0, tip};
Point(9) = {1.5, 0.5, 0, tip};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {8, 9};
Curve{5:7} In Surface{1};

Point(10) = {0.4, 0.25, 0, size};
Point(11) = {1.0, 1.0, 0, size / 2};
Point(12) = {1.7, 0.9, 0, size};
Point{10:12} In Surface{1};

Physical Point("sensors") = {10:12};
Physical Point("tips") = {7:9};
Physical Curve("cracks") = {5:7};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Surface("plate") = {1};
