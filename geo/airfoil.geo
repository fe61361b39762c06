// NACA four-digit airfoil in a channel: sizes that differ by a factor of 30 and a sharp trailing edge.
// The digits are camber and its position (percent and tenths of the chord) and thickness (percent).
DefineConstant[ camber = 2, position = 4, thickness = 12, attack = 6, size = 0.16, fine = 0.006, half = 40 ];

m = camber / 100;
q = position / 10;
t = thickness / 100;
alpha = -attack * Pi / 180;
upper[] = {};
lower[] = {};
For i In {0:half}
  // Cosine spacing: dense at both ends. The last coefficient closes the trailing edge.
  x = (1 - Cos(i * Pi / half)) / 2;
  y = 5 * t * (0.2969 * Sqrt(x) - 0.1260 * x - 0.3516 * x^2 + 0.2843 * x^3 - 0.1036 * x^4);
  c = 0;
  slope = 0;
  If (m > 0)
    If (x < q)
      c = m / q^2 * (2 * q * x - x^2);
      slope = 2 * m / q^2 * (q - x);
    Else
      c = m / (1 - q)^2 * (1 - 2 * q + 2 * q * x - x^2);
      slope = 2 * m / (1 - q)^2 * (q - x);
    EndIf
  EndIf
  a = Atan(slope);
  h = fine * (1 + 3 * Sin(Pi * x)); // finer at the nose and the tail
  xu = x - y * Sin(a);
  yu = c + y * Cos(a);
  p = newp;
  Point(p) = {xu * Cos(alpha) - yu * Sin(alpha), xu * Sin(alpha) + yu * Cos(alpha), 0, h};
  upper[] += {p};
  If (i == 0 || i == half)
    lower[] += {p}; // nose and tail belong to both sides
  Else
    xl = x + y * Sin(a);
    yl = c - y * Cos(a);
    Point(p + 1) = {xl * Cos(alpha) - yl * Sin(alpha), xl * Sin(alpha) + yl * Cos(alpha), 0, h};
    lower[] += {p + 1};
  EndIf
EndFor
Spline(1) = upper[];
Spline(2) = lower[];
Curve Loop(1) = {1, -2};

p = newp;
Point(p) = {-1.5, -1.2, 0, size};
Point(p + 1) = {3.5, -1.2, 0, size};
Point(p + 2) = {3.5, 1.2, 0, size};
Point(p + 3) = {-1.5, 1.2, 0, size};
Line(3) = {p, p + 1};
Line(4) = {p + 1, p + 2};
Line(5) = {p + 2, p + 3};
Line(6) = {p + 3, p};
Curve Loop(2) = {3:6};

Plane Surface(1) = {2, 1};
Physical Curve("airfoil") = {1, 2};
Physical Curve("inlet") = {6};
Physical Curve("outlet") = {4};
Physical Curve("walls") = {3, 5};
Physical Surface("fluid") = {1};
