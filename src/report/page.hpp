// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Pages for people: one file each, which needs no network.

#include <string>

#include "qmorph/gmsh.hpp"
#include "report/recorder.hpp"
#include "report/scene.hpp"
#include "report/stats.hpp"
#include "report/viewpoint.hpp"

namespace qmorph::report {

/// The page of --report: the mesh before and after, its figures, the stages, the options.
/// Cost: linear in the size of the scenes.
std::string report_page(const Scene& before, const Scene& after, const ModelReport& model, const Recorder& recorder,
                        const RunFacts& facts, const Viewpoint& from = Viewpoint::Zero());

/// The page of --film: the fronts of all regions, one after another.
std::string film_page(const ModelReport& model, const Recorder& recorder, const RunFacts& facts,
                      const Viewpoint& from = Viewpoint::Zero());

/// A word of a command line as a shell wants it.
std::string shell_word(const std::string& word);

}  // namespace qmorph::report
