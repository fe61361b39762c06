// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gmsh/read/msh/types.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {

void NodeSet::close() {
  if (!std::is_sorted(tags_.begin(), tags_.end())) std::sort(tags_.begin(), tags_.end());
  consecutive_ = !tags_.empty() && tags_.back() - tags_.front() + std::size_t{1} == tags_.size() &&
                 std::adjacent_find(tags_.begin(), tags_.end()) == tags_.end();
}

bool NodeSet::has(long long tag) const {
  if (tags_.empty() || tag < tags_.front() || tag > tags_.back()) return false;
  return consecutive_ || std::binary_search(tags_.begin(), tags_.end(), static_cast<std::uint32_t>(tag));
}

void MshState::check_node_tag(long long tag) const {
  if (tag > std::numeric_limits<int>::max())
    throw InputError(
        fmt::format("{}: node numbers up to {} leave no room (the largest for Gmsh is {}); renumber the mesh",
                    in.path(), tag, std::numeric_limits<int>::max()));
  if (tag < (version < 4 ? 0 : 1)) in.fail(fmt::format("has a node with the number {}", tag));
}

void MshState::check_node_of(long long element, long long tag) const {
  if (!nodes.has(tag))
    in.fail(fmt::format("contradicts itself: element {} uses node {}, which $Nodes does not have", element, tag));
}

void MshState::check_type(long long type) const {
  if (msh_type(type).nodes == 0)
    in.fail(fmt::format("has elements of type {}, which is none of Gmsh's for lines, surfaces and volumes", type));
}

void MshState::contradicts(std::string_view section, long long stated, long long found) const {
  in.fail(fmt::format("contradicts itself: ${} says {}, and there are {}", section, stated, found));
}

void MshState::check_count(std::string_view section, long long stated) const {
  const bool ends = in.peek_token().substr(0, 1) == "$";
  if (stated >= 0 && ends) return;
  const long long more = ends ? 0 : std::max(in.skip_to_line("$End"), 0LL);
  contradicts(section, stated, std::max(stated, 0LL) + more);
}

void check_data(MshState& state, bool at_nodes_of_elements) {
  MshNumbers& in = state.in;
  for (const char* what : {"texts", "times"}) {
    const long long count = in.word();
    in.line();
    in.require_room(count, 1, what);
    for (long long i = 0; i < count; ++i) in.line();
  }
  const long long integers = in.word();
  in.require_room(integers, 2, "numbers of data");
  long long components = 1, rows = 0;
  for (long long i = 0; i < integers; ++i) {
    const long long value = in.word();
    if (i == 1) components = value;
    if (i == 2) rows = value;
  }
  in.line();
  if (components < 1 || components > 9) in.fail(fmt::format("has data with {} components", components));
  const std::size_t real = in.is_binary() ? sizeof(double) : 2;
  in.require_room(rows, (in.is_binary() ? 4 : 2) + static_cast<std::size_t>(components) * real, "rows of data");
  for (long long i = 0; i < rows; ++i) {
    in.integer();
    const long long nodes = at_nodes_of_elements ? in.integer() : 1;
    in.require_room(nodes, static_cast<std::size_t>(components) * real, "nodes with data");
    in.skip_reals(static_cast<std::size_t>(nodes * components));
  }
}

}  // namespace qmorph::adapter
