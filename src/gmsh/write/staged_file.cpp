// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/staged_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// About one buffer of the C library: with less room than this the last of it may not have reached the disk, and most
/// of Gmsh's writers do not check.
constexpr unsigned long kLeastRoom = 8192;

[[noreturn]] void fail(const std::string& target, const std::string& reason) {
  throw OutputError(fmt::format("cannot write {}: {}", target, reason));
}

/// A link stays a link: what it points to is replaced, or made where there is nothing yet.
fs::path resolve(const std::string& target) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::error_code error;
  fs::path path = fs::absolute(target, error);
  for (int i = 0; fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    if (i == kMostLinks) fail(target, "its links lead back to themselves");
    path = path.parent_path() / fs::read_symlink(path, error);
    if (error) fail(target, error.message());
  }
  const fs::path resolved = fs::weakly_canonical(path, error);
  return error ? path : resolved;
}

bool sync_to_disk(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool synced = ::fsync(file) == 0 || errno == EINVAL;  // some file systems have nothing to sync
  ::close(file);
  return synced;
}

bool disk_is_full(const std::string& path) {
  struct statvfs room {};
  return ::statvfs(path.c_str(), &room) == 0 && room.f_blocks > 0 && room.f_bavail * room.f_frsize < kLeastRoom;
}

/// Process ids would not do: other machines and containers may share the folder.
std::string random_name() {
  std::random_device device;
  return fmt::format(".qmorph-tmp-{:08x}{:08x}", device(), device());
}

/// \return the target with all links followed
fs::path checked_place(const std::string& target) {
  const fs::path resolved = resolve(target);
  std::error_code error;
  const fs::file_status status = fs::status(resolved, error);
  if (fs::is_directory(status)) fail(target, "it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(target, "it is not a regular file");
  if (fs::exists(status) && ::access(resolved.c_str(), W_OK) != 0) fail(target, std::strerror(errno));
  const fs::path directory = resolved.parent_path();
  if (!fs::is_directory(directory, error)) fail(target, "there is no directory " + directory.string());
  if (::access(directory.c_str(), W_OK | X_OK) != 0) fail(target, std::strerror(errno));
  const long longest = ::pathconf(directory.c_str(), _PC_NAME_MAX);
  if (longest > 0 && resolved.filename().string().size() > static_cast<std::size_t>(longest))
    fail(target, std::strerror(ENAMETOOLONG));
  return resolved;
}

}  // namespace

void check_place(const std::string& target) { checked_place(target); }

StagedFile::StagedFile(const std::string& target, const std::string& extension, TemporaryNames* names) : names_(names) {
  const fs::path resolved = checked_place(target);
  target_ = resolved.string();
  for (int file = -1; file < 0;) {
    path_ = (resolved.parent_path() / (random_name() + extension)).string();
    if (names_) names_->add(path_);
    file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // less what the umask says
    if (file >= 0) {
      ::close(file);
    } else {
      const int reason = errno;
      forget();
      if (reason != EEXIST) fail(target, std::strerror(reason));
    }
  }
}

StagedFile::~StagedFile() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove(path_, ignored);
  forget();
}

void StagedFile::forget() {
  if (names_) names_->drop(path_);
  path_.clear();
}

void StagedFile::prepare() {
  if (prepared_) return;
  std::error_code error;
  if (!fs::exists(path_, error) || fs::file_size(path_, error) == 0) fail(target_, "nothing has been written");
  if (!sync_to_disk(path_)) fail(target_, std::strerror(errno));
  if (disk_is_full(path_)) fail(target_, "no space left on the device");
  if (fs::exists(target_, error)) fs::permissions(path_, fs::status(target_).permissions(), error);
  prepared_ = true;
}

void StagedFile::commit() {
  prepare();
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error) fail(target_, error.message());
  forget();
}

void StagedFile::write_text(const std::string& text) {
  std::ofstream out(path_, std::ios::binary);
  out << text;
  out.close();
  if (!out) fail(target_, std::strerror(errno));
}

}  // namespace qmorph::adapter
