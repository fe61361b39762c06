// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files of MSH 2 whose elements of one elementary tag are in several physical groups. Gmsh knows groups of entities
/// only: it would put all these elements in all the groups, and write each once for each group.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace qmorph::adapter {

/// How a file of MSH 2 was taken apart so that each entity has its own groups.
struct Msh2Origin {
  using Entity = std::pair<int, int>;                        ///< dimension, tag
  std::map<Entity, int> elementary;                          ///< of entities whose tag is not the file's
  std::map<Entity, std::vector<int>> more_groups;            ///< of entities that the file has once for each group
  std::map<std::size_t, std::map<int, std::size_t>> copies;  ///< element, group: the element's number there

  bool empty() const { return elementary.empty() && more_groups.empty(); }
};

/// If elementary tags of the file are in several groups each, writes a file to `rewritten` in which none is.
/// Elements with one elementary tag and different groups become entities of their own; where the same elements
/// stand there once for each group, one of them is kept.
/// \pre an ASCII file of MSH 2; Gmsh is initialised
/// \return empty if there is nothing to do; `rewritten` is not touched then
/// \throws InputError if only some of the elements stand there twice
Msh2Origin separate_groups(const std::string& path, const std::string& rewritten);

}  // namespace qmorph::adapter
