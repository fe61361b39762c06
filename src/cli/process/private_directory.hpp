// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A place for temporary files.

#include <string>

namespace qmorph::cli {

/// A directory for the temporary files of one run, or none where there is no place for it.
class PrivateDirectory {
 public:
  PrivateDirectory();
  ~PrivateDirectory() { remove(); }
  PrivateDirectory(const PrivateDirectory&) = delete;
  PrivateDirectory& operator=(const PrivateDirectory&) = delete;
  void remove();
  const std::string& path() const { return path_; }
  /// The file for what libraries say on the standard error.
  std::string foreign_words() const { return path_ + "/said"; }
  std::string read_foreign_words() const;

 private:
  std::string path_;
};

}  // namespace qmorph::cli
