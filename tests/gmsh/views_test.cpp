// SPDX-License-Identifier: GPL-2.0-or-later
/// Data on nodes and elements of a file goes to the quads.

#include "gmsh/views/views.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;
using adapter::ViewStep;

namespace {

using Field = std::function<std::vector<double>(const Eigen::Vector3d& point, int surface)>;

/// What a view of the file is made of.
struct View {
  std::string name, kind;
  Field field;
  int step = 0;
};

Eigen::Vector3d centre_of(const adapter::ModelMesh& mesh, const adapter::ElementBlock& block, std::size_t e) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < block.corners; ++k)
    sum += mesh.points[mesh.rows.find(block.nodes[e * block.nodes_per_element + k])];
  return sum / double(block.corners);
}

void add_view(const View& view, int tag) {
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  std::vector<std::size_t> tags;
  std::vector<std::vector<double>> values;
  if (view.kind == "NodeData") tags = mesh.tags;
  for (std::size_t row = 0; row < tags.size(); ++row) values.push_back(view.field(mesh.points[row], 0));
  for (const auto& entity : mesh.entities)
    for (const auto& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size() && view.kind != "NodeData"; ++e) {
        tags.push_back(block.tags[e]);
        values.emplace_back();
        const int surface = entity.dim == 2 ? entity.tag : 0;
        for (std::size_t k = 0; k < (view.kind == "ElementData" ? 1 : block.nodes_per_element); ++k) {
          const auto at = view.kind == "ElementData"
                              ? centre_of(mesh, block, e)
                              : mesh.points[mesh.rows.find(block.nodes[e * block.nodes_per_element + k])];
          for (double value : view.field(at, surface)) values.back().push_back(value);
        }
      }
  std::string model;
  ::gmsh::model::getCurrent(model);
  const int components = int(view.field({0, 0, 0}, 0).size());
  ::gmsh::view::addModelData(tag, view.step, model, view.kind, tags, values, 0.5 * view.step, components);
}

/// Views of one name are steps of one view.
void make_file_with_views(const std::string& path, double version, bool binary, const std::vector<View>& views,
                          int order = 1, const std::function<void()>& build = build_two_squares) {
  const adapter::Session session;
  build();
  if (order > 1) ::gmsh::model::mesh::setOrder(order);
  ::gmsh::option::setNumber("Mesh.MshFileVersion", version);
  ::gmsh::option::setNumber("Mesh.Binary", binary);
  ::gmsh::option::setNumber("PostProcessing.SaveMesh", 0);
  if (version >= 4) ::gmsh::option::setNumber("Mesh.SaveAll", 1);
  ::gmsh::write(path);
  ::gmsh::clear();
  ::gmsh::open(path);  // with the numbers of the file
  std::map<std::string, int> tags;
  for (const View& view : views) {
    if (!tags.count(view.name)) tags[view.name] = ::gmsh::view::add(view.name);
    add_view(view, tags[view.name]);
  }
  for (const auto& [name, tag] : tags) ::gmsh::view::write(tag, path, true);
}

/// All steps that Gmsh finds in a file, and the mesh.
adapter::MeshData read_data(const std::string& path) {
  const adapter::Session session;
  const auto log = adapter::run_logged([&] { ::gmsh::open(path); });
  CHECK(adapter::first_errors(log) == "no reason given");
  return adapter::read_views();
}

/// Checks a view on all nodes of surfaces, or on all elements of surfaces.
void check_view(const adapter::MeshData& data, const View& view, bool curves_too = true) {
  CAPTURE(view.name);
  const ViewStep* found = nullptr;
  for (const ViewStep& step : data.steps)
    if (step.name == view.name && step.step == view.step) found = &step;
  REQUIRE(found);
  CHECK(found->kind == view.kind);
  CHECK(found->time == 0.5 * view.step);
  std::size_t wrong = 0, missing = 0;
  const auto compare = [&](std::size_t tag, std::size_t offset, const Eigen::Vector3d& at, int surface) {
    const auto* values = found->find(tag);
    const auto expected = view.field(at, surface);
    if (!values) return ++missing, void();
    for (std::size_t c = 0; c < expected.size(); ++c)
      wrong += !(std::abs(values->at(offset * expected.size() + c) - expected[c]) < 1e-9);
  };
  const auto& mesh = data.mesh;
  for (const auto& entity : mesh.entities)
    for (const auto& block : entity.blocks) {
      if (entity.dim != 2 && !(curves_too && entity.dim == 1)) continue;
      const int surface = entity.dim == 2 ? entity.tag : 0;
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        const std::size_t* nodes = block.nodes.data() + e * block.nodes_per_element;
        if (view.kind == "ElementData") compare(block.tags[e], 0, centre_of(mesh, block, e), surface);
        for (std::size_t k = 0; k < block.nodes_per_element && view.kind != "ElementData"; ++k) {
          const bool on_node = view.kind == "NodeData";
          const std::size_t tag = on_node ? nodes[k] : block.tags[e];
          compare(tag, on_node ? 0 : k, mesh.points[mesh.rows.find(nodes[k])], surface);
        }
      }
    }
  CHECK(wrong == 0);
  CHECK(missing == 0);
}

const View kTemperature{
    "temperature in \xC2\xB0"
    "C",
    "NodeData", [](const auto& p, int) { return std::vector{3 + p.x() - 2 * p.y()}; }};
const View kDisplacement{"displacement", "NodeData", [](const auto& p, int) {
                           return std::vector{p.x(), p.y() - p.x(), 1.5};
                         }};
const View kMaterial{"material", "ElementData", [](const auto&, int surface) { return std::vector{10.0 + surface}; }};
const View kStress{"stress", "ElementNodeData",
                   [](const auto& p, int surface) { return std::vector{p.y() + 100 * surface}; }};

}  // namespace

TEST_CASE("views: data on nodes and elements is carried over to the quads' nodes and to the quads") {
  const std::vector<View> views = {kTemperature, kDisplacement, kMaterial, kStress};
  for (double version : {2.2, 4.1})
    for (bool binary : {false, true}) {
      CAPTURE(version);
      CAPTURE(binary);
      const TemporaryDirectory directory;
      make_file_with_views(directory / "in.msh", version, binary, views);
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
      CHECK(result.status == 0);
      CHECK(result.err.find("view") == std::string::npos);
      const adapter::MeshData data = read_data(directory / "out.msh");
      CHECK(data.steps.size() == views.size());
      for (const View& view : views) check_view(data, view);
    }
}

TEST_CASE("views: data stays on its nodes when the version of the file changes") {
  for (const char* format : {"msh22", "msh41"}) {
    const TemporaryDirectory directory;
    make_file_with_views(directory / "in.msh", format == std::string("msh22") ? 4.1 : 2.2, false,
                         {kTemperature, kMaterial});
    CHECK(run_qmorph({directory / "in.msh", "-format", format, "-o", directory / "out.msh"}).status == 0);
    const adapter::MeshData data = read_data(directory / "out.msh");
    check_view(data, kTemperature);
    check_view(data, kMaterial);
  }
}

TEST_CASE("views: each step of a view is kept, with its time") {
  View late = kTemperature;
  late.step = 1;
  late.field = [](const auto& p, int) { return std::vector{7 * p.x()}; };
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {kTemperature, late});
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  const adapter::MeshData data = read_data(directory / "out.msh");
  CHECK(data.steps.size() == 2);
  check_view(data, kTemperature);
  check_view(data, late);
}

TEST_CASE("views: on elements of second order, quadratic data stays exact") {
  const View square{"square", "NodeData",
                    [](const auto& p, int) { return std::vector{p.x() * p.y() + p.x() * p.x()}; }};
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {square}, 2);
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh"}).status == 0);
  check_view(read_data(directory / "out.msh"), square);
}

TEST_CASE("views: nodes that a higher order adds have data too") {
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {kTemperature, kMaterial});
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "-order", "2"}).status == 0);
  const adapter::MeshData data = read_data(directory / "out.msh");
  check_view(data, kTemperature);
  check_view(data, kMaterial);
}

TEST_CASE("views: on a curved surface, new nodes have the data of the side that they are on") {
  const View side{"side", "NodeData", [](const auto& p, int) { return std::vector{p.z()}; }};
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {side}, 1, [] {
    ::gmsh::model::occ::addSphere(0, 0, 0, 1, 1);
    ::gmsh::model::occ::synchronize();
    ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
    ::gmsh::model::mesh::generate(2);
  });
  run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "-order", "2"});
  const adapter::MeshData data = read_data(directory / "out.msh");
  REQUIRE(data.steps.size() == 1);
  CHECK(data.steps[0].tags.size() == data.mesh.tags.size());
  for (std::size_t i = 0; i < data.steps[0].tags.size(); ++i) {
    const auto& p = data.mesh.points[data.mesh.rows.find(data.steps[0].tags[i])];
    CHECK(std::abs(data.steps[0].values[i][0] - p.z()) < 0.1);
  }
}

TEST_CASE("views: nodes that curves get have data too") {
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {kTemperature, kMaterial});
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "odd.msh", "--all-quad"}).status == 0);
  const adapter::MeshData data = read_data(directory / "odd.msh");
  check_view(data, kTemperature);
  check_view(data, kMaterial);
}

TEST_CASE("views: both halves of a line that gets a node have its data, of a higher order, too") {
  const auto build = [] {  // five segments: one of them gets a node
    ::gmsh::model::occ::addRectangle(0, 0, 0, 2, 1, 1);
    ::gmsh::model::occ::synchronize();
    for (const int curve : {1, 3}) ::gmsh::model::mesh::setTransfiniteCurve(curve, curve == 1 ? 6 : 7);
    for (const int curve : {2, 4}) ::gmsh::model::mesh::setTransfiniteCurve(curve, 4);
    ::gmsh::model::mesh::generate(2);
  };
  const View square{"square", "ElementNodeData", [](const auto& p, int) { return std::vector{p.x() * p.x()}; }};
  const View linear{"linear", "ElementNodeData", [](const auto& p, int) { return std::vector{3 * p.x() - p.y()}; }};
  for (const int from : {1, 2})
    for (const std::string to : {"1", "2", "3"}) {
      CAPTURE(from);
      CAPTURE(to);
      const TemporaryDirectory directory;
      const View& at_nodes = from == 2 && to != "1" ? square : linear;
      make_file_with_views(directory / "in.msh", 4.1, false, {kMaterial, at_nodes}, from, build);
      const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--all-quad", "-order", to});
      CHECK(result.status == 0);
      CHECK(result.err.find("1 segment got a node") != std::string::npos);
      const adapter::MeshData data = read_data(directory / "out.msh");
      check_view(data, kMaterial);
      check_view(data, at_nodes);
    }
}

TEST_CASE("views: formats that cannot hold them are reported") {
  const TemporaryDirectory directory;
  make_file_with_views(directory / "in.msh", 4.1, false, {kTemperature});
  for (const std::vector<std::string>& to :
       {std::vector<std::string>{"-o", directory / "out.vtk"}, {"-o", directory / "out.msh", "--for", "elmer"}}) {
    std::vector<std::string> arguments = {directory / "in.msh"};
    arguments.insert(arguments.end(), to.begin(), to.end());
    const Result result = run_qmorph(arguments);
    CHECK(result.status == 0);
    CHECK(result.err.find("data on nodes and elements (views) is not written") != std::string::npos);
  }
}

TEST_CASE("views: partitions lose no data") {
  const View constant{"constant", "ElementData", [](const auto&, int) { return std::vector{7.0}; }};
  for (const char* format : {"msh22", "msh41"}) {
    CAPTURE(format);
    const TemporaryDirectory directory;
    make_file_with_views(directory / "in.msh", 4.1, false, {kTemperature, constant});
    const Result result =
        run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "-part", "2", "-format", format});
    CHECK(result.status == 0);
    const adapter::MeshData data = read_data(directory / "out.msh");
    check_view(data, kTemperature, false);
    check_view(data, constant, false);
  }
}
