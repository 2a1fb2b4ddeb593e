// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/charts_axis.h"

#include "trysquare/report/internal/format.h"

#include <algorithm>
#include <cmath>

namespace trysquare::internal {
namespace {

constexpr double kTickLength = 4;

double round_step(double at_least) {
  const double power = std::pow(10.0, std::floor(std::log10(at_least)));
  for (const double multiple : {1.0, 2.0, 5.0}) {
    if (multiple * power >= at_least * (1 - 1e-9)) return multiple * power;
  }
  return 10 * power;
}

Ticks multiples_of(double step, double low, double high) {
  constexpr double kSlack = 1e-6;
  Ticks marks{.step = step, .values = {}};
  if (!std::isfinite(step)) return marks;
  const double first = std::ceil(low / step - kSlack);
  const double num_ticks = std::floor(high / step + kSlack) - first + 1;
  for (int i = 0; i < static_cast<int>(num_ticks); ++i) marks.values.push_back((first + i) * step);
  return marks;
}

}  // namespace

Ticks ticks(double low, double high, double num_wanted) {
  return multiples_of(round_step((high - low) / num_wanted), low, high);
}

Ticks whole_ticks(double low, double high, double num_wanted) {
  return multiples_of(round_step(std::max(1.0, (high - low) / num_wanted)), low, high);
}

std::string x_axis(const AxisScale& scale, const Ticks& marks, const SvgBox& box, bool with_grid) {
  const double bottom = box.top + box.height;
  std::string body;
  for (const double value : marks.values) {
    const double x = scale.place(value);
    if (with_grid) body += svg_line({x, box.top}, {x, bottom}, "grid");
    body += svg_line({x, bottom}, {x, bottom + kTickLength}, "axis");
    body += svg_text({x, bottom + 16}, "tick", "middle", tick_label(value, marks.step));
  }
  return body + svg_line({box.left, bottom}, {box.left + box.width, bottom}, "axis");
}

std::string y_axis(const AxisScale& scale, const Ticks& marks, const SvgBox& box) {
  std::string body;
  for (const double value : marks.values) {
    const double y = scale.place(value);
    body += svg_line({box.left, y}, {box.left + box.width, y}, "grid");
    body += svg_text({box.left - 7, y + 4}, "tick", "end", tick_label(value, marks.step));
  }
  return body;
}

}  // namespace trysquare::internal
