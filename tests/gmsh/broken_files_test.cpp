// SPDX-License-Identifier: GPL-2.0-or-later
/// Files that would crash Gmsh, or take all memory, are refused by what they say, in every version, as text and as
/// bytes.

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/read/msh/file.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/support.hpp"
#include "qmorph/error.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace std::string_literals;

namespace {

/// A number of a file, as text or as bytes.
class Writer {
 public:
  explicit Writer(bool binary) : binary_(binary) {}
  Writer& text(const std::string& words) { return data_ += words, *this; }
  Writer& integer(std::int32_t value) { return put(value); }
  Writer& size(std::int64_t value) { return put(value); }
  Writer& real(double value) { return put(value); }
  /// The end of a line of numbers.
  Writer& end() { return data_ += binary_ ? "" : "\n", *this; }
  /// The end of a section.
  Writer& close(const std::string& name) { return text(binary_ ? "\n$End" + name + "\n" : "$End" + name + "\n"); }
  const std::string& data() const { return data_; }

 private:
  template <class Number>
  Writer& put(Number value) {
    if (binary_)
      data_.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      data_ += std::to_string(value) + ' ';
    return *this;
  }
  bool binary_;
  std::string data_;
};

/// Two triangles, and what can be wrong with them.
struct Wrong {
  std::int64_t nodes = 4, elements = 2, blocks = 1, type = 2, entity = 1, last_node = 4, tags = 2, number = 2, node = 4;
  std::int64_t block_nodes = 4, block_elements = 2;
};

std::string version_2(bool binary, const Wrong& wrong) {
  Writer out(binary);
  out.text(binary ? "$MeshFormat\n2.2 1 8\n" : "$MeshFormat\n2.2 0 8\n");
  if (binary) out.integer(1).text("\n");
  out.text("$EndMeshFormat\n$Nodes\n" + std::to_string(wrong.nodes) + "\n");
  const double xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) out.integer(i < 3 ? i + 1 : int(wrong.node)).real(xy[i][0]).real(xy[i][1]).real(0).end();
  out.close("Nodes").text("$Elements\n" + std::to_string(wrong.elements) + "\n");
  const auto element = [&](int number, int entity, std::initializer_list<int> nodes) {
    if (!binary)
      out.integer(number).integer(int(wrong.type)).integer(int(wrong.tags));
    else
      out.integer(number);
    const int tags[] = {0, entity, 0, 0};
    for (int k = 0; k < 2; ++k) out.integer(tags[k]);
    for (const int node : nodes) out.integer(node);
    out.end();
  };
  if (binary) out.integer(int(wrong.type)).integer(int(wrong.block_elements)).integer(int(wrong.tags));
  element(1, 1, {1, 2, 3});
  element(int(wrong.number), int(wrong.entity), {1, 3, int(wrong.last_node)});
  return out.close("Elements").data();
}

std::string version_4(bool binary, const Wrong& wrong) {
  Writer out(binary);
  out.text(binary ? "$MeshFormat\n4.1 1 8\n" : "$MeshFormat\n4.1 0 8\n");
  if (binary) out.integer(1).text("\n");
  out.text("$EndMeshFormat\n$Nodes\n").size(1).size(wrong.nodes).size(1).size(4).end();
  out.integer(2).integer(1).integer(0).size(wrong.block_nodes).end();
  for (int i = 0; i < 4; ++i) out.size(i < 3 ? i + 1 : wrong.node).end();
  const double xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : xy) out.real(p[0]).real(p[1]).real(0).end();
  out.close("Nodes").text("$Elements\n").size(wrong.blocks).size(wrong.elements).size(1).size(2).end();
  out.integer(2).integer(int(wrong.entity)).integer(int(wrong.type)).size(wrong.block_elements).end();
  out.size(1).size(1).size(2).size(3).end();
  out.size(wrong.number).size(1).size(3).size(wrong.last_node).end();
  return out.close("Elements").data();
}

/// "" if the file is taken.
std::string complaint(const TemporaryDirectory& directory, const std::string& data) {
  std::filesystem::remove(directory / "in.msh");  // some file systems wait for the disk when a file is cut to nothing
  write_file(directory / "in.msh", data);
  try {
    adapter::check_msh_file(directory / "in.msh", adapter::read_msh_header(directory / "in.msh"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("broken files: text and bytes, version 2 and 4, are refused for the same faults") {
  const struct {
    const char* what;
    std::function<void(Wrong&)> spoil;
    bool of_4 = true, of_2 = true;
  } kCases[] = {
      {"more nodes than there are", [](Wrong& wrong) { wrong.nodes = wrong.block_nodes = 5; }},
      {"fewer nodes than there are", [](Wrong& wrong) { wrong.nodes = 3; }},
      {"a bomb of nodes", [](Wrong& wrong) { wrong.nodes = wrong.block_nodes = 2'000'000'000; }},
      {"nodes below nothing", [](Wrong& wrong) { wrong.nodes = wrong.block_nodes = -1; }},
      {"more elements than there are", [](Wrong& wrong) { wrong.elements = wrong.block_elements = 3; }},
      {"fewer elements than there are", [](Wrong& wrong) { wrong.elements = wrong.block_elements = 1; }},
      {"a bomb of elements", [](Wrong& wrong) { wrong.elements = wrong.block_elements = 2'000'000'000; }},
      {"a bomb of blocks", [](Wrong& wrong) { wrong.blocks = 2'000'000'000; }, true, false},
      {"a bomb of tags", [](Wrong& wrong) { wrong.tags = 2'000'000'000; }, false, true},
      {"tags below nothing", [](Wrong& wrong) { wrong.tags = -2; }, false, true},
      {"no such type", [](Wrong& wrong) { wrong.type = 255; }},
      {"a type of polygons", [](Wrong& wrong) { wrong.type = 34; }},
      {"a type for parts of elements", [](Wrong& wrong) { wrong.type = 135; }},
      {"a type of another dimension", [](Wrong& wrong) { wrong.type = 7; }},
      {"a node that is not there", [](Wrong& wrong) { wrong.last_node = 5; }},
      {"a node below nothing", [](Wrong& wrong) { wrong.last_node = -1; }},
      {"an entity below nothing", [](Wrong& wrong) { wrong.entity = -603979775; }},
      {"an element number below nothing", [](Wrong& wrong) { wrong.number = -7; }},
      {"a node number below nothing", [](Wrong& wrong) { wrong.node = wrong.last_node = -4; }},
      {"a node number that is too large", [](Wrong& wrong) { wrong.node = wrong.last_node = std::int64_t{1} << 40; },
       true, false},
  };
  const TemporaryDirectory directory;
  for (const bool binary : {false, true}) {
    CAPTURE(binary);
    CHECK(complaint(directory, version_2(binary, {})) == "");
    CHECK(complaint(directory, version_4(binary, {})) == "");
    for (const auto& the_case : kCases) {
      CAPTURE(the_case.what);
      Wrong wrong;
      the_case.spoil(wrong);
      if (the_case.of_2) CHECK(complaint(directory, version_2(binary, wrong)) != "");
      if (the_case.of_4) CHECK(complaint(directory, version_4(binary, wrong)) != "");
    }
  }
}

TEST_CASE("broken files: data, periodic nodes, groups and names that reach beyond the file") {
  const std::string mesh = version_2(false, {}), mesh_4 = version_4(false, {});
  const struct {
    std::string text, message;
  } kCases[] = {
      {mesh + "$NodeData\n1\n\"x\"\n1\n0\n3\n0\n1\n2000000000\n1 5\n$EndNodeData\n", "2000000000 rows of data"},
      {mesh + "$ElementNodeData\n1\n\"x\"\n1\n0\n3\n0\n1\n1\n1 1000000\n$EndElementNodeData\n", "nodes with data"},
      {mesh + "$NodeData\n1\n\"x\"\n1\n0\n3\n0\n-5\n1\n1 5\n$EndNodeData\n", "data with -5 components"},
      {mesh + "$Periodic\n1\n1 1 2\n1000000000\n1 2\n$EndPeriodic\n", "more nodes than Gmsh can read"},
      {mesh + "$Periodic\n1\n1 1 2\n1\n1 9\n$EndPeriodic\n", "names node 9"},
      {mesh_4 + "$Periodic\n1\n1 8 9\n0\n1\n1 2\n$EndPeriodic\n", "names the entity 8 of dimension 1"},
      {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 9000000000 0\n$EndEntities\n" + mesh_4.substr(34),
       "entities"},
      {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n7 1 \"x\"\n$EndPhysicalNames\n" + mesh_4.substr(34),
       "a group of dimension 7"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"" + std::string(300, 'x') +
           "\"\n$EndPhysicalNames\n" + mesh.substr(34),
       "has a name of"},
      {mesh.substr(0, mesh.find("$Elements")) + "$Elements\n1\n1 2 5 0 1 9 1 2 1 2 3\n$EndElements\n",
       "in 9 partitions"},
      {mesh.substr(0, mesh.find("$Elements")) + "$Elements\n1\n1 2 4 0 1 1 2000000000 1 2 3\n$EndElements\n",
       "the first is 2000000000"},
      {mesh.substr(0, mesh.find("$Elements")) + "$Elements\n1\n1 2 2 0 1 1 two 3\n$EndElements\n", "has 'two' where"},
      {"$MeshFormat\n4.1 1 4\n\1\0\0\0\n$EndMeshFormat\n$Elements\n$EndElements\n"s, "numbers of 4 bytes"},
  };
  const TemporaryDirectory directory;
  for (const auto& the_case : kCases) {
    CAPTURE(the_case.message);
    const std::string said = complaint(directory, the_case.text);
    CAPTURE(said);
    CHECK(said.find(the_case.message) != std::string::npos);
  }
}

TEST_CASE("broken files: whatever Gmsh writes is accepted") {
  const TemporaryDirectory directory;
  const std::vector<std::function<void()>> models = {
      build_two_squares, [] { build_two_squares(), ::gmsh::model::mesh::setOrder(2); },
      [] { build_two_squares(), ::gmsh::model::mesh::setOrder(3); },
      [] { build_two_squares(), ::gmsh::model::mesh::partition(3); },
      [] {
        ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
        ::gmsh::model::occ::synchronize();
        ::gmsh::model::mesh::setPeriodic(2, {2}, {1}, {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        ::gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
        ::gmsh::model::mesh::generate(3);
      }};
  for (const double version : {1.0, 2.2, 3.0, 4.0, 4.1})
    for (const bool binary : {false, true})
      for (std::size_t i = 0; i < models.size(); ++i) {
        if (binary && (version == 1.0 || version == 4.0)) continue;  // Gmsh has no such
        CAPTURE(version);
        CAPTURE(binary);
        CAPTURE(i);
        make_msh(directory / "in.msh", version, binary, models[i]);
        CHECK(complaint(directory, read_file(directory / "in.msh")) == "");
      }
}

TEST_CASE("broken files: no node of a partitioned mesh of version 3 is taken for a partition") {
  const TemporaryDirectory directory;
  make_msh(directory / "in.msh", 3.0, false, [] { build_two_squares(), ::gmsh::model::mesh::partition(3); });
  const std::string whole = read_file(directory / "in.msh");
  std::size_t changed = 0, line = whole.find('\n', whole.find("$Elements\n") + 10) + 1;  // behind the count
  for (; whole[line] != '$'; line = whole.find('\n', line) + 1) {
    std::istringstream in(whole.substr(line, whole.find('\n', line) - line));
    const std::vector<std::string> words(std::istream_iterator<std::string>(in), {});
    if (words[1] != "2" || words.size() < 8)
      continue;  // number, type, entity, how many follow: three nodes, partitions
    for (std::size_t k = 4; k < 7; ++k) {
      std::vector<std::string> wrong = words;
      wrong[k] = "-1";
      std::string text;
      for (const std::string& word : wrong) text += word + ' ';
      const std::string said =
          complaint(directory, whole.substr(0, line) + text + whole.substr(whole.find('\n', line)));
      CHECK(said.find("uses node -1") != std::string::npos);
      ++changed;
    }
    if (changed > 30) break;
  }
  CHECK(changed > 30);
}

TEST_CASE("broken files: no change of one word of a binary file makes the check itself fail") {
  const TemporaryDirectory directory;
  for (const double version : {2.2, 4.1}) {
    make_msh(directory / "whole.msh", version, true, build_two_squares);
    const std::string whole = read_file(directory / "whole.msh");
    Rng rng(7);
    for (int i = 0; i < 1500; ++i) {
      std::string data = whole;
      const std::size_t at = rng.below(data.size() - 4);
      const std::int32_t value = rng.chance(0.5) ? -1 : 1 << rng.range(0, 30);
      std::memcpy(&data[at], &value, sizeof value);
      CHECK_NOTHROW(complaint(directory, data));
      CHECK_NOTHROW(complaint(directory, data.substr(0, at)));
    }
  }
}
