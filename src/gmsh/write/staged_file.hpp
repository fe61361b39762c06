// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that appear whole or not at all.

#include <string>

#include "gmsh/write/temporary_names.hpp"

namespace qmorph::adapter {

/// Checks that a file can be written there. \throws OutputError if the target is not a regular file, or its directory
/// is missing or not writable
void check_place(const std::string& target);

/// A temporary file beside the file that it will become. Unless it is committed, it is removed.
class StagedFile {
 public:
  /// Creates the file, under a name of its own.
  /// \param extension of the temporary file, since Gmsh chooses the format by it
  /// \param names holds its name for as long as it exists; may be null
  /// \throws OutputError as check_place()
  explicit StagedFile(const std::string& target, const std::string& extension = {}, TemporaryNames* names = nullptr);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Where to write to.
  const std::string& path() const { return path_; }
  /// For small files. \throws OutputError
  void write_text(const std::string& text);
  /// Does all that can fail for lack of space or permissions: prepare all files before committing the first.
  /// \throws OutputError
  void prepare();
  /// Makes the file durable and gives it the target's name. \throws OutputError
  void commit();

 private:
  void forget();

  std::string target_, path_;
  TemporaryNames* names_;
  bool prepared_ = false;
};

}  // namespace qmorph::adapter
