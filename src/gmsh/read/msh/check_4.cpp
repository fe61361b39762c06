// SPDX-License-Identifier: GPL-2.0-or-later
/// Versions 4.0 and 4.1.

#include <fmt/format.h>

#include <algorithm>

#include "gmsh/read/msh/check.hpp"
#include "gmsh/read/msh/types.hpp"

namespace qmorph::adapter {
namespace {

constexpr long long kLargest = std::numeric_limits<int>::max();

void skip_integers(MshNumbers& in, long long count, std::string_view of_what) {
  in.require_room(count, in.is_binary() ? sizeof(int) : 2, of_what);
  for (; count > 0; --count) in.integer();
}

int check_dimension(const MshNumbers& in, long long dim) {
  if (dim < 0 || dim > 3) in.fail(fmt::format("contradicts itself: an entity of dimension {}", dim));
  return static_cast<int>(dim);
}

/// Entities have numbers above 0, but for what other programs write.
int check_tag(const MshNumbers& in, long long tag) {
  if (tag < 0 || tag > kLargest) in.fail(fmt::format("contradicts itself: an entity with the tag {}", tag));
  return static_cast<int>(tag);
}

struct Block {
  int dim = 0, tag = 0;
  long long word = 0;  ///< whether there are parameters, or the type of elements
  long long count = 0;
};

/// What a block of nodes or elements begins with: in 4.0 the tag comes before the dimension.
Block read_block(MshState& state) {
  Block block;
  const long long first = state.in.integer(), second = state.in.integer();
  const bool old = state.version < 4.1;
  block.dim = check_dimension(state.in, old ? second : first);
  block.tag = check_tag(state.in, old ? first : second);
  block.word = state.in.integer();
  block.count = state.in.size();
  return block;
}

/// How many blocks a section has, and how many nodes or elements in all.
std::pair<long long, long long> read_totals(MshState& state, std::string_view what) {
  MshNumbers& in = state.in;
  const long long blocks = in.size(), total = in.size();
  if (state.version >= 4.1) in.size(), in.size();  // the smallest and the largest number; Gmsh looks itself
  in.require_room(blocks, in.is_binary() ? 20 : 8, "blocks");
  in.require_room(total, 2, what);
  return {blocks, total};
}

}  // namespace

void check_entities_of_4(MshState& state, bool partitioned) {
  MshNumbers& in = state.in;
  if (partitioned) {
    in.size();
    const long long ghosts = in.size();
    skip_integers(in, std::min(ghosts, std::numeric_limits<long long>::max() / 2) * 2, "ghost entities");
  }
  long long counts[4];
  for (long long& count : counts) count = in.size();
  for (int dim = 0; dim < 4; ++dim) {
    in.require_room(counts[dim], in.is_binary() ? 36 : 8, "entities");
    for (long long i = 0; i < counts[dim]; ++i) {
      const int tag = check_tag(in, in.integer());
      if (partitioned) {
        in.integer(), in.integer();
        skip_integers(in, in.size(), "partitions");
      }
      in.skip_reals(dim == 0 && (state.version >= 4.1 || in.is_binary()) ? 3 : 6);
      skip_integers(in, in.size(), "groups of an entity");
      if (dim > 0) skip_integers(in, in.size(), "entities around another");
      state.entities.emplace(dim, tag);
    }
  }
}

void check_nodes_of_4(MshState& state) {
  MshNumbers& in = state.in;
  const auto [blocks, total] = read_totals(state, "nodes");
  long long found = 0;
  for (long long b = 0; b < blocks; ++b) {
    const Block block = read_block(state);
    state.entities.emplace(block.dim, block.tag);
    in.require_room(block.count, in.is_binary() ? 32 : 8, "nodes in a block");
    found += block.count;
    const std::size_t reals = 3 + (block.word ? static_cast<std::size_t>(block.dim) : 0);
    const bool tags_first = state.version >= 4.1 || in.is_binary();
    for (long long i = 0; i < block.count; ++i) {
      const long long tag = in.size();
      state.check_node_tag(tag);
      state.nodes.add(tag);
      if (!tags_first) in.skip_reals(reals);
    }
    if (tags_first) in.skip_reals(reals * static_cast<std::size_t>(block.count));
  }
  state.nodes.close();
  state.has_nodes = true;
  if (found != total) state.contradicts("Nodes", total, found);
}

void check_elements_of_4(MshState& state) {
  MshNumbers& in = state.in;
  const auto [blocks, total] = read_totals(state, "elements");
  long long found = 0;
  for (long long b = 0; b < blocks; ++b) {
    const Block block = read_block(state);
    state.check_type(block.word);
    const MshType type = msh_type(block.word);
    if (type.dim != block.dim)
      in.fail(
          fmt::format("contradicts itself: elements of type {} on an entity of dimension {}", block.word, block.dim));
    state.entities.emplace(block.dim, block.tag);
    in.require_room(block.count, in.is_binary() ? 8 * (1 + type.nodes) : 2 * (1 + type.nodes), "elements in a block");
    found += block.count;
    for (long long i = 0; i < block.count; ++i) {
      const long long number = in.size();
      if (number < 1 || number > kLargest)
        in.fail(fmt::format("has an element with the number {}, and Gmsh cannot keep such numbers", number));
      for (std::size_t k = 0; k < type.nodes; ++k) state.check_node_of(number, in.size());
    }
  }
  if (found != total) state.contradicts("Elements", total, found);
  state.elements += static_cast<std::size_t>(total);
  state.has_elements = true;
}

void check_periodic_of_4(MshState& state) {
  MshNumbers& in = state.in;
  const long long links = in.size();
  in.require_room(links, in.is_binary() ? 28 : 8, "periodic entities");
  for (long long i = 0; i < links; ++i) {
    const long long dim = in.integer(), slave = in.integer(), master = in.integer();
    for (const long long tag : {slave, master})
      if (state.has_nodes &&
          (dim < 0 || dim > 2 || !state.entities.count({static_cast<int>(dim), static_cast<int>(tag)})))
        in.fail(fmt::format("contradicts itself: $Periodic names the entity {} of dimension {}, which it does not have",
                            tag, dim));
    if (state.version >= 4.1) {
      const long long reals = in.size();
      in.require_room(reals, in.is_binary() ? sizeof(double) : 2, "numbers of a transformation");
      in.skip_reals(static_cast<std::size_t>(reals));
    } else if (in.peek_token() == "Affine") {
      in.token();
      in.skip_real_words(16);
    }
    const long long nodes = in.size();
    in.require_room(nodes, in.is_binary() ? 16 : 4, "periodic nodes");
    for (long long k = 0; k < 2 * nodes; ++k) in.size();  // Gmsh passes over those that it does not have
  }
}

void check_ghosts_of_4(MshState& state) {
  MshNumbers& in = state.in;
  const long long ghosts = in.size();
  in.require_room(ghosts, in.is_binary() ? 20 : 6, "ghost elements");
  for (long long i = 0; i < ghosts; ++i) {
    in.size();
    in.integer();
    skip_integers(in, in.size(), "partitions of a ghost element");
  }
}

}  // namespace qmorph::adapter
