// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/standard_input.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <istream>
#include <string>
#include <vector>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

/// More than anybody sends; a stream without end has to be cut off somewhere.
constexpr std::size_t kLongestScript = std::size_t{1} << 28;

/// Room that is left to others in the directory for temporary files.
constexpr unsigned long long kLeastRoom = 1ull << 28;

/// What Gmsh is told by the name of a file: meshes, STEP, BREP and scripts begin differently.
std::string extension_of(const std::string& head) {
  const auto has = [&](const char* word) { return head.find(word) != std::string::npos; };
  if (has("$MeshFormat") || has("$NOD")) return ".msh";
  if (has("ISO-10303-21")) return ".step";
  if (has("DBRep_DrawableShape")) return ".brep";
  if (head.find('\0') != std::string::npos)
    throw InputError("standard input is neither a mesh of Gmsh nor STEP, BREP or a script; other formats need a file");
  return ".geo";
}

bool has_room(const std::string& path) {
  struct statvfs room {};
  return ::statvfs(path.c_str(), &room) != 0 || room.f_blocks == 0 ||
         static_cast<unsigned long long>(room.f_bavail) * room.f_frsize > kLeastRoom;
}

}  // namespace

std::unique_ptr<adapter::ScratchFile> read_standard_input(std::istream& in) {
  constexpr std::size_t kHead = 4096;
  std::vector<char> chunk(kChunk);
  const auto take = [&] {
    in.read(chunk.data(), kChunk);
    return static_cast<std::size_t>(in.gcount());
  };
  std::size_t count = take(), total = count;
  if (count == 0) throw InputError("standard input is empty");
  const std::string extension = extension_of(std::string(chunk.data(), std::min(count, kHead)));
  auto file = std::make_unique<adapter::ScratchFile>(extension);
  std::ofstream out(file->path(), std::ios::binary);
  for (; count > 0; count = take(), total += count) {
    if (extension == ".geo" && total > kLongestScript)
      throw InputError("standard input does not end: no script has more than 256 MB");
    if (!has_room(file->path()))
      throw InputError("standard input does not end, or is too large for the directory of temporary files; set TMPDIR");
    out.write(chunk.data(), static_cast<std::streamsize>(count));
  }
  out.close();
  if (!out) throw InputError(std::string("standard input has no room in a temporary file: ") + std::strerror(errno));
  return file;
}

}  // namespace qmorph::cli
