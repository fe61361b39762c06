// A foil with a boundary layer of triangles, as used for viscous flow: rows along the wall, each a fifth higher than the
// one before, and a fan at the sharp trailing edge. The rows become rows of quads of the same heights.
DefineConstant[ thickness = 15, attack = 4, first = 0.0008, growth = 1.2, total = 0.03, size = 0.3, half = 24 ];

t = thickness / 100;
alpha = -attack * Pi / 180;
upper[] = {};
lower[] = {};
For i In {0:half}
  x = (1 - Cos(i * Pi / half)) / 2;
  y = 5 * t * (0.2969 * Sqrt(x) - 0.1260 * x - 0.3516 * x^2 + 0.2843 * x^3 - 0.1036 * x^4);
  h = 0.012 * (1 + 2 * Sin(Pi * x));
  p = newp;
  Point(p) = {x * Cos(alpha) - y * Sin(alpha), x * Sin(alpha) + y * Cos(alpha), 0, h};
  upper[] += {p};
  If (i == 0 || i == half)
    lower[] += {p};
  Else
    Point(p + 1) = {x * Cos(alpha) + y * Sin(alpha), x * Sin(alpha) - y * Cos(alpha), 0, h};
    lower[] += {p + 1};
  EndIf
EndFor
Spline(1) = upper[];
Spline(2) = lower[];
Curve Loop(1) = {1, -2};

p = newp;
Point(p) = {0.5, 0, 0};
Point(p + 1) = {3, 0, 0, size};
Point(p + 2) = {0.5, 2.5, 0, size};
Point(p + 3) = {-2, 0, 0, size};
Point(p + 4) = {0.5, -2.5, 0, size};
Circle(3) = {p + 1, p, p + 2};
Circle(4) = {p + 2, p, p + 3};
Circle(5) = {p + 3, p, p + 4};
Circle(6) = {p + 4, p, p + 1};
Curve Loop(2) = {3:6};
Plane Surface(1) = {2, 1};

Field[1] = BoundaryLayer;
Field[1].EdgesList = {1, 2};
Field[1].FanNodesList = {upper[half]};
Field[1].hwall_n = first;
Field[1].ratio = growth;
Field[1].thickness = total;
Field[1].hfar = size;
BoundaryLayer Field = 1;

Physical Curve("foil") = {1, 2};
Physical Curve("far") = {3:6};
Physical Surface("fluid") = {1};
