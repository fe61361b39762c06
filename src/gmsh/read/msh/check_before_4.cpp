// SPDX-License-Identifier: GPL-2.0-or-later
/// Versions 1, 2 and 3.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "gmsh/read/msh/check.hpp"
#include "gmsh/read/msh/types.hpp"

namespace qmorph::adapter {
namespace {

/// Gmsh makes as many as the largest number says.
constexpr long long kMostPartitions = 1'000'000;

/// One element of one of these versions.
struct Element {
  long long number = 0, type = 0, entity = 0, parent = 0;
};

/// Numbers of elements so far, of which one may be the parent of another. Hardly any file has parents.
class Numbers {
 public:
  void add(long long number) {
    all_.push_back(static_cast<std::uint32_t>(number));
    if (!index_.empty()) index_.insert(all_.back());
  }
  bool has(long long number) {
    if (index_.empty()) index_.insert(all_.begin(), all_.end());
    return number >= 0 && index_.count(static_cast<std::uint32_t>(number)) > 0;
  }

 private:
  std::vector<std::uint32_t> all_;
  std::unordered_set<std::uint32_t> index_;
};

void check_element(const MshState& state, const Element& element, Numbers& numbers) {
  if (element.number < 0 || element.number > std::numeric_limits<int>::max())
    state.in.fail(fmt::format("has an element with the number {}, and Gmsh cannot keep such numbers", element.number));
  if (element.entity < 0 || element.entity > std::numeric_limits<int>::max())
    state.in.fail(
        fmt::format("contradicts itself: element {} has the elementary tag {}, and Gmsh cannot keep tags below 0 "
                    "or above {}",
                    element.number, element.entity, std::numeric_limits<int>::max()));
  if (element.parent != 0 && !numbers.has(element.parent))
    state.in.fail(fmt::format("contradicts itself: element {} is a part of element {}, which does not come before it",
                              element.number, element.parent));
  numbers.add(element.number);
}

void check_element_nodes(MshState& state, long long element, long long count) {
  for (long long k = 0; k < count; ++k) state.check_node_of(element, state.in.integer());
}

/// The tags of an element: group, entity, then how many partitions there are and which, then what it is a part of.
void read_tags(MshState& state, long long count, Element& element) {
  if (count < 0 || count > std::numeric_limits<int>::max())
    state.in.fail(fmt::format("contradicts itself: an element with {} tags", count));
  long long partitions = 0, third = 0, fourth = 0, last = 0;
  for (long long k = 0; k < count; ++k) {
    last = state.in.integer();
    if (k == 1) element.entity = last;
    if (k == 2) third = last;
    if (k == 3) fourth = last;
  }
  if (state.version >= 2.2 && count > 3) partitions = third;
  const long long partition = state.version >= 2.2 ? fourth : third;
  if (partitions < 0 || partitions > std::max(count - 3, 0LL) || partition < 0 || partition > kMostPartitions)
    state.in.fail(fmt::format("contradicts itself: element {} is in {} partitions, the first is {}", element.number,
                              partitions, partition));
  if (state.in.is_binary()) {
    const bool has_parent = state.version < 2.2 ? count > 3 : partitions ? count > 3 + partitions : count > 2;
    if (has_parent) element.parent = last;
  } else if (count == 4 + partitions && count > 3) {
    element.parent = last;
  }
}

void take_elements_of_1(MshState& state, long long count, Numbers& numbers) {
  for (; count > 0; --count) {
    Element element;
    element.number = state.in.integer();
    element.type = state.in.integer();
    state.in.integer();
    element.entity = state.in.integer();
    const long long nodes = state.in.integer();
    state.check_type(element.type);
    if (nodes != static_cast<long long>(msh_type(element.type).nodes))
      state.in.fail(
          fmt::format("contradicts itself: element {} of type {} has {} nodes", element.number, element.type, nodes));
    check_element(state, element, numbers);
    check_element_nodes(state, element.number, nodes);
  }
}

void take_elements_of_2(MshState& state, long long count, Numbers& numbers) {
  while (count > 0) {
    Element element;
    long long block = 1, tags = 0;
    if (state.in.is_binary()) {
      element.type = state.in.integer(), block = state.in.integer(), tags = state.in.integer();
    } else {
      element.number = state.in.integer(), element.type = state.in.integer(), tags = state.in.integer();
    }
    state.check_type(element.type);
    if (block < 1 || block > count)
      state.in.fail(fmt::format("contradicts itself: {} elements in a block, where {} are to come", block, count));
    count -= block;
    for (; block > 0; --block) {
      if (state.in.is_binary()) element.number = state.in.integer();
      read_tags(state, tags, element);
      check_element(state, element, numbers);
      check_element_nodes(state, element.number, static_cast<long long>(msh_type(element.type).nodes));
    }
  }
}

void take_elements_of_3(MshState& state, long long count, Numbers& numbers) {
  for (; count > 0; --count) {
    Element element;
    element.number = state.in.integer();
    element.type = state.in.integer();
    element.entity = state.in.integer();
    const long long words = state.in.integer(), nodes = static_cast<long long>(msh_type(element.type).nodes);
    state.check_type(element.type);
    if (words < nodes) state.in.fail(fmt::format("contradicts itself: element {} has {} nodes", element.number, words));
    check_element(state, element, numbers);
    state.in.require_room(words, 2, "nodes of an element");
    check_element_nodes(state, element.number, nodes);
    for (long long k = 0; k < words - nodes; ++k) state.in.integer();  // partitions, parents
  }
}

}  // namespace

void check_nodes_before_4(MshState& state, bool parametric) {
  MshNumbers& in = state.in;
  const long long count = in.word();
  in.line();
  in.require_room(count, in.is_binary() ? 28 : 8, "nodes");
  for (long long i = 0; i < count; ++i) {
    const long long tag = in.integer();
    state.check_node_tag(tag);
    state.nodes.add(tag);
    in.skip_reals(3);
    if (parametric) {
      const long long dim = in.integer();
      in.integer();
      if (dim == 1 || dim == 2) in.skip_reals(static_cast<std::size_t>(dim));
    }
    if (state.version >= 3 && in.integer() != 0) {
      const long long dim = in.integer();
      if (dim < 0 || dim > 3)
        in.fail(fmt::format("contradicts itself: node {} is on an entity of dimension {}", tag, dim));
      in.skip_reals(static_cast<std::size_t>(dim));
    }
  }
  state.check_count(parametric ? "ParametricNodes" : "Nodes", count);
  state.nodes.close();
  state.has_nodes = true;
}

void check_elements_before_4(MshState& state) {
  MshNumbers& in = state.in;
  const long long count = in.word();
  in.line();
  if (count >= 0) in.require_room(count, in.is_binary() ? 8 : 6, "elements");
  Numbers numbers;
  if (state.version < 2)
    take_elements_of_1(state, count, numbers);
  else if (state.version < 3)
    take_elements_of_2(state, count, numbers);
  else
    take_elements_of_3(state, count, numbers);
  state.elements += static_cast<std::size_t>(std::max(count, 0LL));
  state.has_elements = true;
  state.check_count("Elements", count);
}

void check_entities_of_3(MshState& state) {
  MshNumbers& in = state.in;  // text in binary files, too
  long long counts[4];
  for (long long& count : counts) count = in.word();
  for (int dim = 0; dim < 4; ++dim) {
    in.require_room(counts[dim], 4, "entities");
    for (long long i = 0; i < counts[dim]; ++i) {
      state.entities.emplace(dim, static_cast<int>(in.word()));
      for (int list = dim == 0 ? 1 : 0; list < 2; ++list) {  // what bounds it, its groups
        const long long words = in.word();
        in.require_room(words, 2, "tags of an entity");
        for (long long k = 0; k < words; ++k) in.word();
      }
    }
  }
}

void check_periodic_before_4(MshState& state) {
  constexpr std::size_t kLongestWord = 6;  // Gmsh has room for so many characters
  MshNumbers& in = state.in;               // text in binary files, too
  const long long links = in.word();
  in.require_room(links, 8, "periodic entities");
  for (long long i = 0; i < links; ++i) {
    for (int k = 0; k < 3; ++k) in.word();
    if (in.peek_token() == "Affine") {
      in.token();
      in.skip_real_words(16);
    } else if (in.peek_token().size() > kLongestWord) {
      in.fail("has a $Periodic with more nodes than Gmsh can read; use MSH 4.1");
    }
    const long long nodes = in.word();
    in.require_room(nodes, 4, "periodic nodes");
    for (long long k = 0; k < 2 * nodes; ++k) {
      const long long tag = in.word();
      if (!state.nodes.has(tag))
        in.fail(fmt::format("contradicts itself: $Periodic names node {}, which $Nodes does not have", tag));
    }
  }
}

}  // namespace qmorph::adapter
