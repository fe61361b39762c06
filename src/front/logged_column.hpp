// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A column of values by index that can go back to where a transaction began.

#include <utility>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::front {

template <class T>
class LoggedColumn {
 public:
  T operator[](Index i) const { return i < values_.size() ? T(values_[i]) : T{}; }
  void set(Index i, T value) {
    if (i >= values_.size()) values_.resize(std::size_t(i) + 1 + i / 2, T{});
    if (recording_) log_.emplace_back(i, values_[i]);
    values_[i] = value;
  }
  void begin() {
    recording_ = true;
    log_.clear();
  }
  /// Indices that the last transaction set. Until the next begin().
  template <class Visit>
  void for_logged(const Visit& visit) const {
    for (const auto& entry : log_) visit(entry.first);
  }
  void commit() { recording_ = false; }
  void rollback() {
    recording_ = false;
    for (auto it = log_.rbegin(); it != log_.rend(); ++it) values_[it->first] = it->second;
  }

 private:
  std::vector<T> values_;
  std::vector<std::pair<Index, T>> log_;
  bool recording_ = false;
};

}  // namespace qmorph::front
