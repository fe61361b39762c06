// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "report/depth_buffer.hpp"

namespace qmorph::report {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kLongSide = 400, kMargin = 3;  // points
constexpr int kShades = 40;
constexpr Colour kSides{64, 64, 64}, kInk{16, 16, 16}, kPlain{255, 255, 255}, kWhite{255, 255, 255};
/// Of a typical element's size; in points not more than the second number.
constexpr double kThin = 0.05, kMostThin = 0.5, kThick = 0.16, kMostThick = 1.4, kMark = 0.24, kMostMark = 4;
/// Of white, how light a face is that is seen from its side, where faces have no colour.
constexpr double kDimmest = 0.55;

/// How nodes are marked, by valence; 0: all others.
struct Mark {
  int valence, sides;
  double size;
  Colour colour;
};
constexpr std::array kMarks = {Mark{3, 3, 1.25, {232, 89, 12}}, Mark{5, 5, 1, {28, 95, 212}},
                               Mark{0, 16, 0.95, {17, 17, 17}}};

class Picture {
 public:
  Picture(const Scene& scene, PictureColour colour, const Viewpoint& from)
      : scene_(scene),
        colour_(colour),
        figures_(measure(scene)),
        frame_(find_frame(scene)),
        is_flat_(frame_.flat && from.isZero()) {
    project(turn_of(frame_, from).rows());
    colour_faces();
    std::vector<float> sizes = figures_.size;
    std::sort(sizes.begin(), sizes.end());
    if (!sizes.empty()) typical_ = scale_ * sizes[sizes.size() / 2];
  }

  Drawing run() {
    if (is_flat_)
      draw_flat();
    else
      draw_in_space();
    return std::move(drawing_);
  }

 private:
  /// Places on the page, and depths in its unit.
  void project(const Eigen::Matrix3d& turn) {
    std::vector<Eigen::Vector3d> turned;
    for (const auto& p : scene_.points) turned.push_back(turn * frame_.to_frame(p));
    Eigen::AlignedBox2d box;
    for (const auto& face : scene_.faces)
      for (Index i = 0; i < corners_of(face); ++i) box.extend(turned[face[i]].head<2>());
    if (box.isEmpty()) return;
    scale_ = kLongSide / std::max(box.sizes().maxCoeff(), 1e-300);
    drawing_.size = scale_ * box.sizes() + Vec2::Constant(2 * kMargin);
    for (const auto& p : turned) {
      places_.emplace_back(scale_ * (p.head<2>() - box.min()) + Vec2::Constant(kMargin));
      depths_.push_back(scale_ * p.z());
    }
  }

  void colour_faces() {
    const std::vector<float>* values = colour_ == PictureColour::scaled_jacobian ? &figures_.scaled_jacobian
                                       : colour_ == PictureColour::eta           ? &figures_.eta
                                       : colour_ == PictureColour::thesis_metric ? &figures_.thesis_metric
                                                                                 : &figures_.size;
    shades_.assign(scene_.faces.size(), kPlain);
    if (colour_ == PictureColour::none && !is_flat_) shade_faces();
    if (colour_ == PictureColour::none || values->empty()) return;
    const bool is_size = colour_ == PictureColour::size;
    const auto [low, high] = std::minmax_element(figures_.size.begin(), figures_.size.end());
    const double least = std::log(*low), range = std::max(std::log(*high) - least, 1e-9);
    for (std::size_t f = 0; f < shades_.size(); ++f) {
      const double value = (*values)[f], t = is_size ? (std::log(value) - least) / range : value;
      const int shade = std::clamp(int(t * kShades), 0, kShades - 1);
      shades_[f] = std::isnan(value)        ? kUndefinedColour
                   : !is_size && value <= 0 ? kInvertedColour
                                            : on_scale((shade + 0.5) / kShades);
    }
  }

  /// In the light of a lamp at the eye: without it a surface of one colour has no shape.
  void shade_faces() {
    for (std::size_t f = 0; f < shades_.size(); ++f) {
      const auto& n = scene_.faces[f];
      const Index last = corners_of(n) - 1;
      const Eigen::Vector3d normal = (at(n[2]) - at(n[0])).cross(at(n[last]) - at(n[1])).stableNormalized();
      const double light = kDimmest + (1 - kDimmest) * std::abs(normal.z());
      shades_[f].red = shades_[f].green = shades_[f].blue = std::uint8_t(std::lround(255 * light));
    }
  }
  Eigen::Vector3d at(Index node) const { return {places_[node].x(), places_[node].y(), depths_[node]}; }

  Path path_of(std::size_t f) const {
    Path path;
    for (Index i = 0; i < corners_of(scene_.faces[f]); ++i) path.points.push_back(places_[scene_.faces[f][i]]);
    return path;
  }
  Path segment(const std::array<Index, 2>& ends) const { return {{places_[ends[0]], places_[ends[1]]}, false}; }

  double thin() const { return std::min(kMostThin, kThin * typical_); }
  double thick() const { return std::clamp(kThick * typical_, 0.5, kMostThick); }

  void draw_flat() {
    std::map<std::array<int, 3>, Shape> by_colour;
    for (std::size_t f = 0; f < scene_.faces.size(); ++f) {
      const Colour& c = shades_[f];
      Shape& shape = by_colour[{c.red, c.green, c.blue}];
      shape.fill = c, shape.stroke = kSides, shape.width = thin();
      shape.paths.push_back(path_of(f));
    }
    for (auto& [key, shape] : by_colour) drawing_.shapes.push_back(std::move(shape));
    Shape curves{{}, {}, kInk, thick()};
    for (const auto& edge : figures_.open_edges) curves.paths.push_back(segment(edge));
    for (const auto& line : scene_.lines) curves.paths.push_back(segment(line));
    if (!curves.paths.empty()) drawing_.shapes.push_back(std::move(curves));
    Shape dots{{}, kInk, {}, 0};
    for (Index v : scene_.dots) dots.paths.push_back(polygon(places_[v], 1.1 * thick(), 12));
    if (!dots.paths.empty()) drawing_.shapes.push_back(std::move(dots));
    if (colour_ != PictureColour::none) draw_marks([](Index) { return true; });
  }

  static Path polygon(const Vec2& middle, double radius, int sides) {
    Path path;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides + std::numbers::pi / 2;
      path.points.emplace_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return path;
  }

  template <class Seen>
  void draw_marks(const Seen& sees) {
    const double radius = std::min(kMostMark, kMark * typical_);
    for (const Mark& mark : kMarks) {
      Shape shape{{}, mark.colour, kWhite, std::min(0.3, 0.15 * radius)};
      for (const auto& [node, valence] : figures_.irregular)
        if (mark.valence == (valence == 3 || valence == 5 ? valence : 0) && sees(node))
          shape.paths.push_back(polygon(places_[node], mark.size * radius, mark.sides));
      if (!shape.paths.empty()) drawing_.shapes.push_back(std::move(shape));
    }
  }

  /// What is seen, from back to front; a curve comes with the faces beside it, so that what is behind stays hidden.
  void draw_in_space() {
    std::set<std::array<Index, 2>> thick_edges;
    const auto sorted = [](Index a, Index b) { return std::array<Index, 2>{std::min(a, b), std::max(a, b)}; };
    for (const auto& edge : figures_.open_edges) thick_edges.insert(sorted(edge[0], edge[1]));
    for (const auto& line : scene_.lines) thick_edges.insert(sorted(line[0], line[1]));
    std::vector<Eigen::Vector3d> points;
    for (Index v = 0; v < places_.size(); ++v) points.push_back(at(v));
    const DepthBuffer buffer(points, scene_.faces);
    for (std::size_t f : buffer.back_to_front()) {
      drawing_.shapes.push_back({{path_of(f)}, shades_[f], kSides, thin()});
      Shape curves{{}, {}, kInk, thick()};
      const auto& face = scene_.faces[f];
      for (Index i = 0, n = corners_of(face); i < n; ++i)
        if (thick_edges.contains(sorted(face[i], face[(i + 1) % n])))
          curves.paths.push_back(segment({face[i], face[(i + 1) % n]}));
      if (!curves.paths.empty()) drawing_.shapes.push_back(std::move(curves));
    }
    if (colour_ != PictureColour::none) draw_marks([&](Index v) { return buffer.sees(points[v]); });
  }

  const Scene& scene_;
  PictureColour colour_;
  SceneFigures figures_;
  Frame frame_;
  bool is_flat_;
  std::vector<Vec2> places_;
  std::vector<double> depths_;
  std::vector<Colour> shades_;
  double scale_ = 1, typical_ = 10;
  Drawing drawing_;
};

}  // namespace

std::optional<PictureColour> find_picture_colour(std::string_view name) {
  if (name == "sj") return PictureColour::scaled_jacobian;
  if (name == "eta") return PictureColour::eta;
  if (name == "thesis") return PictureColour::thesis_metric;
  if (name == "size") return PictureColour::size;
  if (name == "none") return PictureColour::none;
  return std::nullopt;
}

Drawing draw(const Scene& scene, PictureColour colour, const Viewpoint& from) {
  return Picture(scene, colour, from).run();
}

Scene at_stage(const Scene& after, const ModelReport& model, const Recorder& recorder, Stage stage) {
  Scene scene = after;
  scene.faces.clear();
  scene.face_tags.clear();
  for (SceneEntity& surface : scene.surfaces) {
    const SceneEntity was = surface;
    surface.first = scene.faces.size();
    const auto report = std::find_if(model.surfaces.begin(), model.surfaces.end(),
                                     [&](const SurfaceReport& s) { return s.tag == surface.tag; });
    const bool is_image = report != model.surfaces.end() && report->image_of != 0;
    const History* history = report == model.surfaces.end() || is_image ? nullptr : recorder.find(*report);
    if (!history) {
      scene.faces.insert(scene.faces.end(), after.faces.begin() + std::ptrdiff_t(was.first),
                         after.faces.begin() + std::ptrdiff_t(was.first + was.count));
    } else {
      for (const QuadMesh& mesh : history->stages[std::size_t(stage)].meshes) {
        const Index offset = Index(scene.points.size());
        scene.points.insert(scene.points.end(), mesh.points.begin(), mesh.points.end());
        for (const auto& t : mesh.triangles)
          scene.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset, kNone});
        for (const auto& q : mesh.quads)
          scene.faces.push_back({q[0] + offset, q[1] + offset, q[2] + offset, q[3] + offset});
      }
    }
    surface.count = scene.faces.size() - surface.first;
  }
  scene.node_tags.resize(scene.points.size(), 0);
  scene.face_tags.resize(scene.faces.size(), 0);
  return scene;
}

}  // namespace qmorph::report
