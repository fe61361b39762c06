// Coated fibres in a matrix on a substrate: six surfaces in four materials that share their curves, so the quads of
// neighbours have to meet at the same nodes.
DefineConstant[ radius = 0.16, coating = 0.05, size = 0.04 ];

Point(1) = {0, 0, 0, size};
Point(2) = {1.2, 0, 0, size};
Point(3) = {1.2, 0.25, 0, size};
Point(4) = {0, 0.25, 0, size};
Point(5) = {1.2, 1.25, 0, size};
Point(6) = {0, 1.25, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4}; // shared by substrate and matrix
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1:4};
Curve Loop(2) = {-3, 5, 6, 7};

Macro Ring // a circle of radius r around (x, y); its curve loop is `loop`
  p = newp;
  Point(p) = {x, y, 0};
  Point(p + 1) = {x + r, y, 0, h};
  Point(p + 2) = {x, y + r, 0, h};
  Point(p + 3) = {x - r, y, 0, h};
  Point(p + 4) = {x, y - r, 0, h};
  c = newc;
  Circle(c) = {p + 1, p, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4};
  Circle(c + 3) = {p + 4, p, p + 1};
  loop = newreg;
  Curve Loop(loop) = {c:c + 3};
Return

holes[] = {};
fibres[] = {};
coatings[] = {};
For i In {0:1}
  x = 0.35 + 0.45 * i;
  y = 0.6 + 0.3 * i;
  r = radius;
  h = size / 2;
  Call Ring;
  inner = loop;
  r = radius + coating;
  Call Ring;
  s = news;
  Plane Surface(s) = {inner};
  Plane Surface(s + 1) = {loop, inner};
  fibres[] += {s};
  coatings[] += {s + 1};
  holes[] += {loop};
EndFor
s = news;
Plane Surface(s) = {1};
Plane Surface(s + 1) = {2, holes[]};

Physical Curve("ground") = {1};
Physical Curve("interface") = {3};
Physical Curve("top") = {6};
Physical Surface("substrate") = {s};
Physical Surface("matrix") = {s + 1};
Physical Surface("coating") = coatings[];
Physical Surface("fibre") = fibres[];
