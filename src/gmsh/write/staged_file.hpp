#pragma once
/// Files that are either whole or not there.

#include <string>

namespace qmorph::adapter {

/// A temporary file beside the file that it will become. What is not committed is removed.
class StagedFile {
 public:
  /// \param extension of the temporary file, since Gmsh chooses the format by it; the target's if empty
  /// \throws OutputError if the target is no regular file, or its directory is missing or not writable
  explicit StagedFile(const std::string& target, const std::string& extension = {});
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Where to write to.
  const std::string& path() const { return path_; }
  /// For small files. \throws OutputError
  void write_text(const std::string& text);
  /// Does all that can fail for want of room or rights: of several files, prepare all before committing the first.
  /// \throws OutputError
  void prepare();
  /// Makes the file durable and gives it the target's name. \throws OutputError
  void commit();

 private:
  std::string target_, path_;
  bool prepared_ = false;
};

}  // namespace qmorph::adapter
