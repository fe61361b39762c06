// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The files of src/report/page, joined by join.cmake when the project is built.

#include <string_view>

namespace qmorph::report {

/// They wait for {{TITLE}}, {{FACTS}} (JSON) and {{NUMBERS}} (base64), in this order.
extern const std::string_view kReportPage;
extern const std::string_view kFilmPage;

}  // namespace qmorph::report
