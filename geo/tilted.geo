// A folded sheet in space: two panels, each with an opening, in two tilted planes that share the crease.
// Nothing lies in z = 0, so code that looks at x and y alone gets it wrong.
DefineConstant[ fold = 70, tilt = 35, size = 0.06 ];

// The first panel lies in a plane that is tilted about x; the second is turned by `fold` about the crease.
ct = Cos(tilt * Pi / 180);
st = Sin(tilt * Pi / 180);
cf = Cos((tilt + fold) * Pi / 180);
sf = Sin((tilt + fold) * Pi / 180);

Macro Corner // point `p` at (u, v) of the panel whose upward direction is (0, c, s), moved away from the origin
  Point(p) = {3 + u, -1 + v * c, 2 + v * s, h};
Return

h = size;
c = ct; s = st;
p = 1; u = 0; v = -1; Call Corner;
p = 2; u = 1.6; v = -1; Call Corner;
p = 3; u = 1.6; v = 0; Call Corner;
p = 4; u = 0; v = 0; Call Corner;
h = size / 2;
p = 11; u = 0.4; v = -0.7; Call Corner; // a slot with round ends
p = 12; u = 1.2; v = -0.7; Call Corner;
p = 13; u = 1.2; v = -0.4; Call Corner;
p = 14; u = 0.4; v = -0.4; Call Corner;
p = 15; u = 0.4; v = -0.55; Call Corner;
p = 16; u = 1.2; v = -0.55; Call Corner;
p = 17; u = 0.25; v = -0.55; Call Corner;
p = 18; u = 1.35; v = -0.55; Call Corner;
h = size;
c = cf; s = sf;
p = 5; u = 1.3; v = 0.9; Call Corner;
p = 6; u = 0.3; v = 0.9; Call Corner;
h = size / 2;
p = 21; u = 0.6; v = 0.25; Call Corner; // a lozenge
p = 22; u = 0.8; v = 0.15; Call Corner;
p = 23; u = 1.0; v = 0.45; Call Corner;
p = 24; u = 0.8; v = 0.65; Call Corner;

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4}; // the crease
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1:4};
Curve Loop(2) = {-3, 5, 6, 7};
Line(11) = {11, 12};
Circle(12) = {12, 16, 18};
Circle(13) = {18, 16, 13};
Line(14) = {13, 14};
Circle(15) = {14, 15, 17};
Circle(16) = {17, 15, 11};
Curve Loop(3) = {11:16};
Line(21) = {21, 22};
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 21};
Curve Loop(4) = {21:24};

Plane Surface(1) = {1, 3};
Plane Surface(2) = {2, 4};
Physical Curve("crease") = {3};
Physical Curve("openings") = {11:16, 21:24};
Physical Surface("lower panel") = {1};
Physical Surface("upper panel") = {2};
