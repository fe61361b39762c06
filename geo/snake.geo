// A band that winds: fronts that close in the middle of a long, narrow, curved domain.
DefineConstant[ waves = 2.5, amplitude = 0.35, width = 0.3, size = 0.05, points = 60 ];

upper[] = {};
lower[] = {};
length = 3;
For i In {0:points}
  x = length * i / points;
  k = 2 * Pi * waves / length;
  y = amplitude * Sin(k * x);
  a = Atan(amplitude * k * Cos(k * x));
  w = width / 2 * (1 - 0.8 * (x / length)^4); // it has a tail
  p = newp;
  Point(p) = {x - w * Sin(a), y + w * Cos(a), 0, size};
  Point(p + 1) = {x + w * Sin(a), y - w * Cos(a), 0, size};
  upper[] += {p};
  lower[] += {p + 1};
EndFor
// The head is an arc around a point of the centre line.
a = Atan(amplitude * k);
p = newp;
Point(p) = {0, 0, 0};
Point(p + 1) = {-width / 2 * Cos(a), -width / 2 * Sin(a), 0, size};
Spline(1) = upper[];
Spline(2) = lower[];
Line(3) = {lower[points], upper[points]};
Circle(4) = {upper[0], p, p + 1};
Circle(5) = {p + 1, p, lower[0]};
Curve Loop(1) = {2, 3, -1, 4, 5};

Plane Surface(1) = {1};
Physical Curve("skin") = {1, 2};
Physical Curve("head") = {4, 5};
Physical Curve("tail") = {3};
Physical Surface("snake") = {1};
