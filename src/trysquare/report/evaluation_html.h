// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trysquare {

/// The evaluation as one HTML page that needs nothing else: no script, no network, figures inside; dark and light, on
/// paper and on a phone. A view of the JSON that to_json(const Evaluation&, ...) writes: whatever is undefined there
/// shows its reason. Derived for reading are only the square roots of the variances, in millimetres.
/// Same JSON, same bytes.
///
/// @throws InvalidArgument  if the text is no JSON of the schema "trysquare.evaluation/1".
std::string to_html(std::string_view evaluation_json);

}  // namespace trysquare
