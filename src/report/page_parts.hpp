// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What all pages have in common.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/blob.hpp"

namespace qmorph::report {

/// The page of page_sources.hpp with its title, facts and numbers in the places that wait for them.
std::string fill_page(std::string_view page, const std::string& title, const nlohmann::ordered_json& facts,
                      const Blob& blob);

/// `qmorph` and the words, quoted as a shell wants them.
std::string command_line(const std::vector<std::string>& arguments);

/// What is behind the last slash.
std::string file_name(const std::string& path);

}  // namespace qmorph::report
