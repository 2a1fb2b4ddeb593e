// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <string>
#include <string_view>

namespace trysquare::internal {

/// Pieces of a page. Names say what is HTML already (`html`); every other string is escaped here.

/// <section> with a heading; empty html gives an empty text.
std::string html_section(std::string_view heading, const std::string& html);

std::string html_paragraph(std::string_view css_class, std::string_view text);

/// One headline number: its short name, what that means, the number (HTML) and lines of support below it (HTML).
std::string html_card(std::string_view name, std::string_view meaning, const std::string& number_html,
                      const std::string& support_html);

/// The word "undefined" and the reason.
std::string html_undefined(std::string_view reason);

/// object[key] as a quantity, or "undefined" and the reason.
std::string html_value(const Json& object, const std::string& key, std::string_view unit);

std::string html_cell(std::string_view css_class, const std::string& html);
std::string html_row(std::string_view cell_element, const std::vector<std::string>& cells_html);

/// A table that scrolls sideways where it is wider than the screen.
std::string html_table(std::string_view css_class, const std::string& head_html, const std::string& body_html);

/// Rows "label | value" of an object of inputs or settings: nested objects are flattened, null is the reason or "none".
std::string html_fact_rows(const Json& object, const std::string& prefix);

/// The page's style sheet: light and dark, screen and paper.
std::string html_style();

}  // namespace trysquare::internal
