// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The inside of `check_msh_file`: sections of the versions, one after another. Everything that Gmsh's readers take for
/// granted is looked at: counts, that every number refers to something that exists, that types exist.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gmsh/read/msh/file.hpp"
#include "gmsh/read/msh/numbers.hpp"

namespace qmorph::adapter {

/// Numbers of nodes: dense or not, in any order.
class NodeSet {
 public:
  void add(long long tag) { tags_.push_back(static_cast<std::uint32_t>(tag)); }
  bool has(long long tag) const;
  /// To be called once all are there.
  void close();

 private:
  std::vector<std::uint32_t> tags_;  ///< in order
  bool consecutive_ = false;
};

/// What is known of a file by the time a section begins.
struct MshState {
  MshNumbers& in;
  double version = 0;
  NodeSet nodes{};
  std::set<std::pair<int, int>> entities{};  ///< dimension, tag: declared, or with nodes
  bool has_nodes = false;
  std::size_t elements = 0;
  bool has_elements = false;

  /// \throws InputError for a number that Gmsh cannot hold
  void check_node_tag(long long tag) const;
  void check_node_of(long long element, long long tag) const;
  void check_type(long long type) const;
  void contradicts(std::string_view section, long long stated, long long found) const;
  /// Of a section with a line for each thing: whether it ends where it says.
  void check_count(std::string_view section, long long stated) const;
};

/// Each reads from the line after the section's name to before the line with its end.
void check_nodes_before_4(MshState& state, bool parametric);
void check_elements_before_4(MshState& state);
void check_entities_of_3(MshState& state);
void check_periodic_before_4(MshState& state);

void check_entities_of_4(MshState& state, bool partitioned);
void check_nodes_of_4(MshState& state);
void check_elements_of_4(MshState& state);
void check_periodic_of_4(MshState& state);
void check_ghosts_of_4(MshState& state);

/// $NodeData, $ElementData, $ElementNodeData, of all versions.
void check_data(MshState& state, bool at_nodes_of_elements);

}  // namespace qmorph::adapter
