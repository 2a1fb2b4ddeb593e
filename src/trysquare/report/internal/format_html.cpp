// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format_html.h"

#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <vector>

namespace trysquare::internal {
namespace {

bool is_reason(const std::string& key) {
  constexpr std::string_view kEnd = "_reason";
  return key.size() > kEnd.size() && key.compare(key.size() - kEnd.size(), kEnd.size(), kEnd) == 0;
}

std::string fact_text(const Json& value, std::string_view unit) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  std::string text;
  if (value.is_array()) {
    for (const Json& element : value) text += (text.empty() ? "" : ", ") + fact_text(element, "");
    return text.empty() ? "none" : text;
  }
  text = value.is_number_integer() ? count(value) : exact(value.get<double>());
  return unit.empty() ? text : text + "\u00A0" + unit_symbol(unit);
}

}  // namespace

std::string html_section(std::string_view heading, const std::string& html) {
  if (html.empty()) return "";
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape(heading), html);
}

std::string html_paragraph(std::string_view css_class, std::string_view text) {
  return fmt::format("<p class=\"{}\">{}</p>\n", css_class, escape(text));
}

std::string html_card(std::string_view name, std::string_view meaning, const std::string& number_html,
                      const std::string& support_html) {
  return fmt::format("<div class=\"card\"><h3>{} <small>{}</small></h3>\n<p class=\"number\">{}</p>\n{}</div>\n",
                     escape(name), escape(meaning), number_html, support_html);
}

std::string html_undefined(std::string_view reason) {
  return fmt::format("<span class=\"undefined-value\">undefined</span> <span class=\"reason\">{}</span>",
                     escape(reason));
}

std::string html_value(const Json& object, const std::string& key, std::string_view unit) {
  if (!has(object, key)) return html_undefined(reason_of(object, key));
  return escape(quantity(object.at(key).get<double>(), unit));
}

std::string html_cell(std::string_view css_class, const std::string& html) {
  return fmt::format("<td class=\"{}\">{}</td>", css_class, html);
}

std::string html_row(std::string_view cell_element, const std::vector<std::string>& cells_html) {
  std::string row = "<tr>";
  for (const std::string& cell : cells_html) row += fmt::format("<{0}>{1}</{0}>", cell_element, cell);
  return row + "</tr>\n";
}

std::string html_table(std::string_view css_class, const std::string& head_html, const std::string& body_html) {
  const std::string head = head_html.empty() ? "" : "<thead>" + head_html + "</thead>\n";
  return fmt::format("<div class=\"wide\"><table class=\"{}\">\n{}<tbody>\n{}</tbody></table></div>\n", css_class, head,
                     body_html);
}

std::string html_fact_rows(const Json& object, const std::string& prefix) {
  std::string rows;
  for (const auto& [key, value] : object.items()) {
    if (is_reason(key)) continue;
    const std::string label = prefix + label_of(key);
    if (value.is_object()) {
      rows += html_fact_rows(value, label + ": ");
      continue;
    }
    const std::string text = value.is_null() ? (has(object, key + "_reason") ? reason_of(object, key) : "none")
                                             : fact_text(value, unit_of(key));
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td{}>{}</td></tr>\n", escape(label),
                        value.is_null() ? " class=\"reason\"" : "", escape(text));
  }
  return rows;
}

}  // namespace trysquare::internal
