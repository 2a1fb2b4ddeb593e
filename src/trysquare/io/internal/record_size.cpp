// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/record_size.h"

#include <fmt/format.h>

namespace trysquare::internal {

void require_bytes_for(std::uint64_t num_records, std::size_t stride, std::string_view body, std::size_t body_offset,
                       std::string_view name) {
  if (num_records > body.size() / stride) {
    fail_at_byte(name, body_offset,
                 fmt::format("the file ends early: {} bytes from here, expected {} points of {} bytes", body.size(),
                             num_records, stride));
  }
}

void require_text_for(std::uint64_t num_records, std::size_t num_values, std::string_view text, const LineReader& lines,
                      std::string_view name) {
  const std::size_t num_bytes = text.size() - lines.offset() + 1;  // the last line may lack its line end
  if (num_records > num_bytes / (2 * num_values)) {
    fail_at_byte(name, lines.offset(),
                 fmt::format("the file ends early: {} bytes from here, expected {} lines of {} values", num_bytes - 1,
                             num_records, num_values));
  }
}

}  // namespace trysquare::internal
