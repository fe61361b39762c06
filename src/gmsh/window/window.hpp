// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's own window.

#include <string>

namespace qmorph::adapter {

/// Why no window can be opened here, or an empty string. \pre Gmsh is initialised, and has no window yet. A process of its
/// own tries, since the window's toolkit ends the process where it finds no display.
std::string find_no_window();

/// Opens a mesh file in Gmsh's window and waits until it is closed. The window lives in a process of its own, since its
/// toolkit ends the process where it finds no display. \return what went wrong, or an empty string
std::string show_in_window(const std::string& path);

}  // namespace qmorph::adapter
