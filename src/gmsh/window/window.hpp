// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's own window.

#include <string>

namespace qmorph::adapter {

/// Where a window is to be opened, looked at before Gmsh's toolkit ends the process because there is nothing. To be kept
/// until the window is there: some displays forget all when nobody looks at them any more.
class Display {
 public:
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  /// Why there can be no window, or an empty string.
  const std::string& trouble() const { return trouble_; }

 private:
  void* connection_ = nullptr;
  std::string trouble_;
};

/// Opens a mesh file in Gmsh's window and waits until it is closed. The window lives in a process of its own, since its
/// toolkit ends the process where it finds no display. \return what went wrong, or an empty string
std::string show_in_window(const std::string& path);

}  // namespace qmorph::adapter
