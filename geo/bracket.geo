// L-bracket with a filleted inner corner, rounded ends and two bolt holes: rows have to follow concave and convex arcs.
DefineConstant[ leg = 1, arm = 0.8, thick = 0.25, fillet = 0.15, round = 0.06, bolt = 0.05, size = 0.025 ];

// Outline, counter-clockwise from the outer corner.
Point(1) = {0, 0, 0, size};
Point(2) = {leg - round, 0, 0, size};
Point(3) = {leg, round, 0, size};
Point(4) = {leg, thick - round, 0, size};
Point(5) = {leg - round, thick, 0, size};
Point(6) = {thick + fillet, thick, 0, size / 2};
Point(7) = {thick, thick + fillet, 0, size / 2};
Point(8) = {thick, arm - round, 0, size};
Point(9) = {thick - round, arm, 0, size};
Point(10) = {0, arm, 0, size};
Point(11) = {leg - round, round, 0};             // centres
Point(12) = {leg - round, thick - round, 0};
Point(13) = {thick + fillet, thick + fillet, 0};
Point(14) = {thick - round, arm - round, 0};
Line(1) = {1, 2};
Circle(2) = {2, 11, 3};
Line(3) = {3, 4};
Circle(4) = {4, 12, 5};
Line(5) = {5, 6};
Circle(6) = {6, 13, 7};
Line(7) = {7, 8};
Circle(8) = {8, 14, 9};
Line(9) = {9, 10};
Line(10) = {10, 1};
Curve Loop(1) = {1:10};

Macro Bolt // a circle around (x, y); its curve loop is `loop`, its curves are added to `bolts[]`
  p = newp;
  Point(p) = {x, y, 0};
  Point(p + 1) = {x + bolt, y, 0, size / 1.5};
  Point(p + 2) = {x, y + bolt, 0, size / 1.5};
  Point(p + 3) = {x - bolt, y, 0, size / 1.5};
  Point(p + 4) = {x, y - bolt, 0, size / 1.5};
  c = newc;
  Circle(c) = {p + 1, p, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4};
  Circle(c + 3) = {p + 4, p, p + 1};
  loop = newreg;
  Curve Loop(loop) = {c:c + 3};
  bolts[] += {c:c + 3};
Return

bolts[] = {};
x = leg - thick / 2; y = thick / 2;
Call Bolt;
loop1 = loop;
x = thick / 2; y = arm - thick / 2;
Call Bolt;

Plane Surface(1) = {1, loop1, loop};
Physical Curve("wall") = {10};
Physical Curve("fillet") = {6};
Physical Curve("bolts") = bolts[];
Physical Surface("bracket") = {1};
