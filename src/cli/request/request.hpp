// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From words on the command line to what is wanted.

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace qmorph::cli {

/// What --check asks of a mesh.
struct Thresholds {
  double min_scaled_jacobian = 0;  ///< at or below which a quad is bad
  double max_irregular = 1;        ///< share of the interior nodes
  bool no_triangles = false;
  double max_distance = std::numeric_limits<double>::infinity();  ///< from another mesh, in edges
  std::optional<double> max_size_ratio;  ///< of the median lengths, along and across, over those of another mesh
};

/// One call of the command.
struct Request {
  std::string input, output, format, stats, report, film;
  std::string depfile;                         ///< for a rule of make
  std::string svg, pdf, tikz;                  ///< files for pictures
  std::string stage = "final", colour = "sj";  ///< of the pictures
  std::string from;                            ///< from where pictures and pages are seen, or empty
  std::vector<std::string> merged;             ///< further files, merged with the input
  std::string consumer;                        ///< of --for
  std::string elements;                        ///< family of a deck's surface elements; empty: the mesh decides
  Thresholds thresholds;
  std::string against;  ///< file with the mesh that --check measures distances to, or empty
  std::vector<int> surfaces;
  std::string smoothing;              ///< the method, or empty
  bool layers = true;                 ///< rows of triangles along walls stay rows
  std::optional<double> crease;       ///< angle in degrees
  std::vector<std::string> settings;  ///< NAME=VALUE for set_option()
  int verbosity = 0;
  bool help = false, version = false;
  bool from_stdin = false, to_stdout = false;  ///< input or output is a temporary file in its place
  bool cleanup_only = false;                   ///< improve the quads that are there
  bool all_quad = false;                       ///< curves may get nodes so that no triangle is left
  std::vector<int> keep_curves;
  bool orient = false;      ///< neighbouring elements agree in the end
  bool views = false;       ///< figures go into the mesh file, or beside it
  bool view = false;        ///< Gmsh's window in the end
  bool gui = false;         ///< Gmsh's window with a panel, and nothing else
  bool check = false;       ///< judge the mesh, write nothing
  bool no_meshing = false;  ///< -save: what has no elements gets none
  bool drop_volumes = false;
  bool ignore_periodicity = false;
  std::string background;  ///< -bgm, or empty
  int dimension = 2;       ///< 3: volumes are meshed on the quads
  int partitions = 0;      ///< of -part
  int threads = 0;         ///< of -nt; 0: as many as the machine has
  bool algorithm_chosen = false, order_chosen = false;
  std::optional<double> msh_version;        ///< of -setnumber Mesh.MshFileVersion
  std::optional<bool> binary;               ///< of -bin, or of -setnumber Mesh.Binary
  std::vector<std::string> meshing_words;   ///< options that matter only where Gmsh meshes, as they were given
  std::vector<std::string> option_names;    ///< of Gmsh ("Mesh.Smoothing"), set by -setnumber and -setstring
  std::vector<std::string> option_files;    ///< of -option
  std::vector<std::string> gmsh_arguments;  ///< for Gmsh, in their order: the last one of a kind wins

  bool wants_picture() const { return !svg.empty() || !pdf.empty() || !tikz.empty(); }
};

/// \throws UsageError naming the word that is wrong
Request parse(const std::vector<std::string>& arguments);

/// The text of --help.
std::string help_text();

}  // namespace qmorph::cli
