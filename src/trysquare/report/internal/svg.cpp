// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/svg.h"

#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trysquare::internal {
namespace {

/// Two decimals are a fiftieth of a pixel; "-0.00" would be another text for the same place.
std::string coordinate(double value) { return fmt::format("{:.2f}", std::round(value * 100) / 100 + 0.0); }

std::string title_element(std::string_view title) {
  return title.empty() ? "" : "<title>" + escape(title) + "</title>";
}

std::string attribute(std::string_view name, std::string_view value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, value);
}

std::string svg_element(const Drawing& drawing, std::string_view attributes, std::string_view before) {
  return fmt::format("<svg{} viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}\n{}</svg>\n", attributes,
                     coordinate(drawing.width), coordinate(drawing.height), escape(drawing.title), before,
                     drawing.body);
}

}  // namespace

std::string svg_text(SvgPoint at, std::string_view css_class, std::string_view anchor, std::string_view text) {
  return fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n", coordinate(at.x),
                     coordinate(at.y), css_class, anchor, escape(text));
}

std::string svg_line(SvgPoint from, SvgPoint to, std::string_view css_class) {
  return fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"{}\"/>\n", coordinate(from.x),
                     coordinate(from.y), coordinate(to.x), coordinate(to.y), css_class);
}

std::string svg_box(const SvgBox& box, std::string_view css_class, std::string_view fill, std::string_view title) {
  return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"{}\"{}>{}</rect>\n",
                     coordinate(box.left), coordinate(box.top), coordinate(box.width), coordinate(box.height),
                     css_class, attribute("fill", fill), title_element(title));
}

std::string svg_circle(SvgPoint center, double radius, std::string_view css_class, std::string_view title) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" class=\"{}\">{}</circle>\n", coordinate(center.x),
                     coordinate(center.y), coordinate(radius), css_class, title_element(title));
}

std::string svg_path(const std::vector<SvgPoint>& points, std::string_view css_class, std::string_view stroke,
                     std::string_view title) {
  std::string data;
  std::string previous;
  std::size_t num_written = 0;
  for (const SvgPoint& point : points) {
    const std::string place = coordinate(point.x) + " " + coordinate(point.y);
    if (place == previous) continue;
    data += (num_written == 0 ? "M" : "L") + place;
    previous = place;
    ++num_written;
  }
  if (num_written == 1) data += "L" + previous;
  return fmt::format("<path d=\"{}\" class=\"{}\"{}>{}</path>\n", data, css_class, attribute("stroke", stroke),
                     title_element(title));
}

std::string svg_dots(const std::vector<SvgPoint>& points, std::string_view css_class, std::string_view stroke) {
  std::vector<std::string> places;
  places.reserve(points.size());
  for (const SvgPoint& point : points) places.push_back(coordinate(point.x) + " " + coordinate(point.y));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::string data;
  for (const std::string& place : places) data += "M" + place + "h0";
  return fmt::format("<path d=\"{}\" class=\"{}\"{}/>\n", data, css_class, attribute("stroke", stroke));
}

std::string inline_svg(const Drawing& drawing) { return svg_element(drawing, " class=\"figure\"", ""); }

std::string standalone_svg(const Drawing& drawing) {
  constexpr double kPixelsPerUnit = 1.5;
  constexpr double kMargin = 12;
  Drawing framed = drawing;
  framed.width += 2 * kMargin;
  framed.height += 2 * kMargin;
  framed.body = fmt::format("<g transform=\"translate({0} {0})\">\n{1}</g>\n", kMargin, drawing.body);
  const std::string attributes =
      fmt::format(" xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" class=\"figure\"",
                  coordinate(framed.width * kPixelsPerUnit), coordinate(framed.height * kPixelsPerUnit));
  const std::string style =
      "<style>.figure{font-family:system-ui,'Helvetica Neue',Arial,sans-serif}" + figure_style() + "</style>";
  const std::string paper = "\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg_element(framed, attributes, style + paper);
}

std::string figure_style() {
  return R"(
.figure text{font-size:11px;fill:#5b6470;font-variant-numeric:tabular-nums}
.figure .name{font-size:12.5px;font-weight:600;fill:#1b2128}
.figure .mark-label{font-weight:600;fill:#1b2128;stroke:#ffffff;stroke-width:3px;stroke-linejoin:round;
paint-order:stroke}
.figure .grid{stroke:#e6e9ed;stroke-width:1}
.figure .axis{stroke:#b3bac3;stroke-width:1}
.figure .casing{fill:none;stroke:#39424d;stroke-opacity:.5;stroke-width:7;stroke-linecap:round;stroke-linejoin:round}
.figure .path{fill:none;stroke:#c3c9d0;stroke-width:1.5;stroke-linejoin:round}
.figure .segment{fill:none;stroke-width:5;stroke-linecap:round;stroke-linejoin:round}
.figure .undefined{fill:none;stroke:#7d8791;stroke-width:3;stroke-dasharray:4 3}
.figure .gap{fill:#e9ecef}
.figure .series{fill:none;stroke:#2a6f97;stroke-width:1.75;stroke-linejoin:round;stroke-linecap:round}
.figure .dot{fill:#2a6f97;stroke:#ffffff;stroke-width:1}
.figure .hollow{fill:#ffffff;stroke:#2a6f97;stroke-width:1.5}
.figure .cloud{fill:none;stroke-width:1.3;stroke-linecap:round}
.figure .start{fill:#ffffff;stroke:#1b2128;stroke-width:2}
.figure .end{fill:#1b2128;stroke:#ffffff;stroke-width:1}
)";
}

std::string figure_style_dark() {
  return R"(
.figure text{fill:#a3adb8}
.figure .name{fill:#e8ecf0}
.figure .mark-label{fill:#e8ecf0;stroke:#171b20}
.figure .grid{stroke:#2a3037}
.figure .axis{stroke:#505a65}
.figure .casing{stroke:#d5dbe1;stroke-opacity:.55}
.figure .path{stroke:#505a65}
.figure .undefined{stroke:#8a949e}
.figure .gap{fill:#262c33}
.figure .series{stroke:#6cb5dc}
.figure .dot{fill:#6cb5dc;stroke:#171b20}
.figure .hollow{fill:#171b20;stroke:#6cb5dc}
.figure .start{fill:#171b20;stroke:#e8ecf0}
.figure .end{fill:#e8ecf0;stroke:#171b20}
)";
}

std::string color_of(double share) {
  struct Color {
    double red, green, blue;
  };
  constexpr std::array<Color, 7> kAnchors = {
      {{62, 38, 122}, {54, 84, 158}, {36, 122, 158}, {34, 154, 138}, {92, 184, 100}, {176, 208, 64}, {250, 222, 70}}};
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kAnchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kAnchors.size() - 2);
  const double weight = place - static_cast<double>(below);
  const Color& a = kAnchors[below];
  const Color& b = kAnchors[below + 1];
  const auto mix = [weight](double from, double to) {
    return static_cast<int>(std::lround(from + weight * (to - from)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue));
}

}  // namespace trysquare::internal
