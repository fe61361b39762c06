// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/msh2_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>

#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

using Entity = Msh2Origin::Entity;

/// One line of $Elements: number, type, count of tags, tags (group, elementary, partitions), nodes.
struct Element {
  std::vector<long long> words;

  explicit Element(const std::string& line) {
    const char* at = line.c_str();
    for (char* end = nullptr;; at = end) {
      const long long word = std::strtoll(at, &end, 10);
      if (end == at) break;
      words.push_back(word);
    }
  }
  bool has_tags() const { return words.size() > 5 && words[2] >= 2 && words.size() > 3 + std::size_t(words[2]); }
  int type() const { return static_cast<int>(words[1]); }
  std::size_t number() const { return static_cast<std::size_t>(words[0]); }
  int group() const { return static_cast<int>(words[3]); }
  int elementary() const { return static_cast<int>(words[4]); }
  std::vector<long long> sorted_nodes() const {
    std::vector<long long> nodes(words.begin() + 3 + words[2], words.end());
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
};

/// Dimensions of Gmsh's element types.
class Dimensions {
 public:
  int operator()(int type) {
    const auto [found, is_new] = known_.emplace(type, 0);
    if (is_new) {
      std::string name;
      int order = 0, nodes = 0, primary_nodes = 0;
      std::vector<double> local;
      ::gmsh::model::mesh::getElementProperties(type, name, found->second, order, nodes, local, primary_nodes);
    }
    return found->second;
  }

 private:
  std::map<int, int> known_;
};

/// Calls `take(line, inside)` for each line; `inside` is true for those that are elements.
void for_each_line(const std::string& path, const std::function<void(const std::string&, bool)>& take) {
  std::ifstream in(path, std::ios::binary);
  bool inside = false, count = false;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '$') inside = false;
    take(line, inside && !count && !line.empty());
    if (inside) count = false;
    if (line.rfind("$Elements", 0) == 0) inside = count = true;
  }
}

struct Groups {
  std::map<Entity, std::set<int>> of;  ///< groups of the elements of an elementary tag
  std::map<int, int> largest;          ///< elementary tag of a dimension
};

Groups find_groups(const std::string& path) {
  Groups groups;
  Dimensions dimension;
  for_each_line(path, [&](const std::string& line, bool is_element) {
    if (!is_element) return;
    const Element element(line);
    if (!element.has_tags()) return;
    const int dim = dimension(element.type());
    groups.of[{dim, element.elementary()}].insert(element.group());
    int& largest = groups.largest[dim];
    largest = std::max(largest, element.elementary());
  });
  return groups;
}

/// One elementary tag with several groups: each element, by its nodes, with its number in each group.
using Members = std::map<std::vector<long long>, std::map<int, std::size_t>>;

std::map<Entity, Members> find_members(const std::string& path, const Groups& groups) {
  std::map<Entity, Members> members;
  Dimensions dimension;
  for_each_line(path, [&](const std::string& line, bool is_element) {
    if (!is_element) return;
    const Element element(line);
    if (!element.has_tags()) return;
    const Entity entity{dimension(element.type()), element.elementary()};
    if (groups.of.at(entity).size() > 1) members[entity][element.sorted_nodes()][element.group()] = element.number();
  });
  return members;
}

/// What becomes of an element of a mixed entity.
struct Fate {
  bool dropped = false;
  int elementary = 0;
};

/// Decides for each mixed entity: taken apart by group, or once for all its groups.
std::map<std::size_t, Fate> decide(Groups& groups, const std::map<Entity, Members>& mixed, Msh2Origin& origin) {
  std::map<std::size_t, Fate> fates;
  for (const auto& [entity, members] : mixed) {
    const std::set<int>& all = groups.of.at(entity);
    const bool repeated = members.begin()->second.size() == all.size();
    std::map<int, int> tag_of_group;
    for (int group : all) tag_of_group[group] = tag_of_group.empty() ? entity.second : ++groups.largest[entity.first];
    for (const auto& [nodes, numbers] : members) {
      if (numbers.size() != (repeated ? all.size() : 1))
        throw InputError(
            fmt::format("element {} stands in the file once for each of {} physical groups, and others with the "
                        "elementary tag {} do not; give each group its own elementary tag",
                        numbers.begin()->second, numbers.size(), entity.second));
      const auto first = numbers.begin();
      fates[first->second] = {false, repeated ? entity.second : tag_of_group.at(first->first)};
      for (auto it = std::next(first); it != numbers.end(); ++it) fates[it->second] = {true, 0};
      if (repeated) origin.copies[first->second] = {std::next(first), numbers.end()};
    }
    if (repeated)
      origin.more_groups[entity] = {std::next(all.begin()), all.end()};
    else
      for (const auto& [group, tag] : tag_of_group)
        if (tag != entity.second) origin.elementary[{entity.first, tag}] = entity.second;
  }
  return fates;
}

void rewrite(const std::string& path, const std::string& rewritten, const std::map<std::size_t, Fate>& fates) {
  std::vector<std::string> before, elements, after;
  for_each_line(path, [&](const std::string& line, bool is_element) {
    if (!is_element) return (elements.empty() ? before : after).push_back(line);
    Element element(line);
    const auto fate = fates.find(element.number());
    if (fate == fates.end()) return elements.push_back(line);
    if (fate->second.dropped) return;
    element.words[4] = fate->second.elementary;
    elements.push_back(fmt::format("{}", fmt::join(element.words, " ")));
  });
  before.back() = std::to_string(elements.size());  // the count comes last before the elements
  std::ofstream out(rewritten, std::ios::binary);
  for (const auto* lines : {&before, &elements, &after})
    for (const std::string& line : *lines) out << line << '\n';
  out.close();
  if (!out) throw InputError("cannot write to the temporary file " + rewritten);
}

}  // namespace

Msh2Origin separate_groups(const std::string& path, const std::string& rewritten) {
  Groups groups = find_groups(path);
  if (std::all_of(groups.of.begin(), groups.of.end(), [](const auto& entry) { return entry.second.size() < 2; }))
    return {};
  Msh2Origin origin;
  rewrite(path, rewritten, decide(groups, find_members(path, groups), origin));
  return origin;
}

}  // namespace qmorph::adapter
