// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Reading a file beside the current model.

#include <string>
#include <vector>

namespace qmorph::adapter {

/// A separate model, empty and current, for as long as this object lives. Views that a file brings into it go with it.
class GuestModel {
 public:
  GuestModel();
  ~GuestModel();
  GuestModel(const GuestModel&) = delete;
  GuestModel& operator=(const GuestModel&) = delete;
  const std::vector<int>& views_before() const { return views_; }

 private:
  std::string host_;
  std::vector<int> views_;
};

/// Puts the nodes of the current model, which has been read from this file, to where the file has them.
void place_nodes_as_in(const std::string& path);

}  // namespace qmorph::adapter
