// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the command says, line by line, in the names that its user knows.

#include <ostream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

namespace qmorph::cli {

/// A stream on its way to another one. Names of temporary files are replaced by what they stand for, in Gmsh's
/// messages, too.
class ErrorStream : public std::ostream {
 public:
  explicit ErrorStream(std::ostream& target) : std::ostream(&buffer_), buffer_(target) {}
  ~ErrorStream() override { flush(); }
  /// From now on `path` is called `name`.
  void call(const std::string& path, const std::string& name) { buffer_.names.emplace_back(path, name); }

 private:
  /// Holds a line back until it is whole, or flushed.
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::ostream& target) : target_(target) {}
    std::vector<std::pair<std::string, std::string>> names;

   protected:
    int_type overflow(int_type c) override;
    int sync() override;

   private:
    std::ostream& target_;
    std::string line_;
  };

  Buffer buffer_;
};

}  // namespace qmorph::cli
