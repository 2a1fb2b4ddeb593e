// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// A place in the figure's units; y points down.
struct SvgPoint {
  double x = 0;
  double y = 0;
};

/// A rectangle in the figure's units.
struct SvgBox {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// `text` and `title` are escaped here, `css_class` is ours. `anchor`: "start", "middle" or "end".
std::string svg_text(SvgPoint at, std::string_view css_class, std::string_view anchor, std::string_view text);
std::string svg_line(SvgPoint from, SvgPoint to, std::string_view css_class);
/// `fill`: a color, or empty when the class gives it. `title`: what a browser shows under the pointer; empty: nothing.
std::string svg_box(const SvgBox& box, std::string_view css_class, std::string_view fill, std::string_view title);
std::string svg_circle(SvgPoint center, double radius, std::string_view css_class, std::string_view title);
/// Points that fall on the one before are left out. One point alone becomes a dot.
std::string svg_path(const std::vector<SvgPoint>& points, std::string_view css_class, std::string_view stroke,
                     std::string_view title);

/// Small dots, each where a point is; those in the same hundredth of a unit are one.
std::string svg_dots(const std::vector<SvgPoint>& points, std::string_view css_class, std::string_view stroke);

/// Everything a figure consists of, before it is put into a page or a file.
struct Drawing {
  double width = 0;
  double height = 0;
  std::string title;  ///< For screen readers.
  std::string body;
};

/// For a page that has figure_style() in its style sheet.
std::string inline_svg(const Drawing& drawing);

/// A file of its own: light, on white, with literal colors, so that it prints and opens in every drawing program.
std::string standalone_svg(const Drawing& drawing);

/// Style rules of the classes that figures use, in the light colors; and what changes in the dark.
std::string figure_style();
std::string figure_style_dark();

/// Color of a share in [0, 1], from indigo (small) over teal to yellow (large): luminance rises all the way, so that
/// the order survives in grey and for color-blind readers. "#rrggbb".
std::string color_of(double share);

}  // namespace trysquare::internal
