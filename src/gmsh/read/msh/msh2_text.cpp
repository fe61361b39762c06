// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/msh2_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Nodes of Gmsh's element types.
class NodeCounts {
 public:
  int operator()(int type) {
    const auto [found, is_new] = known_.emplace(type, 0);
    if (is_new) {
      std::string name;
      int dim = 0, order = 0, primary_nodes = 0;
      std::vector<double> local;
      ::gmsh::model::mesh::getElementProperties(type, name, dim, order, found->second, local, primary_nodes);
    }
    return found->second;
  }

 private:
  std::map<int, int> known_;
};

class Translation {
 public:
  Translation(const std::string& path, const std::string& text)
      : path_(path), in_(path, std::ios::binary), text_(text), out_(text, std::ios::binary) {}
  void run();

 private:
  [[noreturn]] void fail() const { throw InputError(fmt::format("{} ends too soon: it is not complete", path_)); }
  template <class Number>
  Number raw();
  std::string line();
  /// Copies a line with a count.
  long long count();
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    if (buffer_.size() > (std::size_t{1} << 20)) flush();
  }
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }
  void header();
  void nodes();
  void elements();
  void data(bool at_nodes);

  const std::string& path_;
  std::ifstream in_;
  const std::string& text_;
  std::ofstream out_;
  fmt::memory_buffer buffer_;
  bool swapped_ = false;  ///< the other order of bytes
};

template <class Number>
Number Translation::raw() {
  std::array<char, sizeof(Number)> bytes{};
  if (!in_.read(bytes.data(), bytes.size())) fail();
  if (swapped_) std::reverse(bytes.begin(), bytes.end());
  Number number;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

std::string Translation::line() {
  std::string text;
  if (!std::getline(in_, text)) fail();
  return text;
}

long long Translation::count() {
  const std::string text = line();
  put("{}\n", text);
  return std::strtoll(text.c_str(), nullptr, 10);
}

void Translation::header() {
  const std::string format = line();
  const std::size_t space = format.find(' ');
  put("{} 0 8\n", format.substr(0, space));
  swapped_ = raw<std::int32_t>() != 1;
}

void Translation::nodes() {
  for (long long left = count(); left > 0; --left) {
    const auto tag = raw<std::int32_t>();
    const double x = raw<double>(), y = raw<double>(), z = raw<double>();
    put("{} {} {} {}\n", tag, x, y, z);
  }
}

void Translation::elements() {
  NodeCounts node_count;
  for (long long left = count(); left > 0;) {
    const auto type = raw<std::int32_t>(), block = raw<std::int32_t>(), tags = raw<std::int32_t>();
    if (block < 1 || tags < 0) fail();
    const int words = tags + node_count(type);
    for (std::int32_t e = 0; e < block; ++e, --left) {
      put("{} {} {}", raw<std::int32_t>(), type, tags);
      for (int k = 0; k < words; ++k) put(" {}", raw<std::int32_t>());
      put("\n");
    }
  }
}

void Translation::data(bool at_nodes) {
  for (long long left = count(); left > 0; --left) put("{}\n", line());  // texts
  for (long long left = count(); left > 0; --left) put("{}\n", line());  // reals
  long long components = 0, rows = 0;
  const long long integers = count();
  for (long long i = 0; i < integers; ++i) {
    const long long value = count();
    if (i == 1) components = value;
    if (i == 2) rows = value;
  }
  for (; rows > 0; --rows) {
    put("{}", raw<std::int32_t>());
    const std::int32_t nodes = at_nodes ? raw<std::int32_t>() : 1;
    if (at_nodes) put(" {}", nodes);
    for (long long k = 0; k < nodes * components; ++k) put(" {}", raw<double>());
    put("\n");
  }
}

void Translation::run() {
  std::string text;
  while (std::getline(in_, text)) {
    if (text.empty()) continue;  // behind binary numbers
    put("{}\n", text);
    if (text == "$MeshFormat") header();
    if (text == "$Nodes") nodes();
    if (text == "$Elements") elements();
    if (text == "$NodeData" || text == "$ElementData") data(false);
    if (text == "$ElementNodeData") data(true);
    if (text == "$InterpolationScheme") throw InputError(path_ + " has a $InterpolationScheme; write it in ASCII");
  }
  flush();
  out_.close();
  if (!out_) throw InputError("cannot write to the temporary file " + text_);
}

}  // namespace

void write_msh2_as_text(const std::string& path, const std::string& text) { Translation(path, text).run(); }

}  // namespace qmorph::adapter
