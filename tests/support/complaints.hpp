// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Collects what a checker found: some lines of each kind, and how many more there were.

#include <Eigen/Core>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace qmorph::test {

class Complaints {
 public:
  /// Adds "rule: details", unless there are enough lines of this rule already.
  template <class... Parts>
  void add(const std::string& rule, const Parts&... parts) {
    if (++count_[rule] > kEach) return;
    std::ostringstream text;
    text.precision(9);
    text << rule << ": ";
    (text << ... << parts);
    lines_.push_back(text.str());
  }

  bool empty() const { return lines_.empty(); }

  std::vector<std::string> lines() const {
    std::vector<std::string> result = lines_;
    for (const auto& [rule, count] : count_)
      if (count > kEach) result.push_back(rule + ": " + std::to_string(count - kEach) + " more");
    return result;
  }

 private:
  static constexpr int kEach = 3;
  std::vector<std::string> lines_;
  std::map<std::string, int> count_;
};

inline std::string at(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text.precision(9);
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

}  // namespace qmorph::test
