// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options/options.h"
#include "proc/align/place/tags/printed_tag.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// `text` as ID=twelve numbers, the corners, or ID=SIZE and nine numbers: the centre and the
/// directions to the right and down as one reads the tag. Error: anything else.
Result<align::PrintedTag> parse_tag(const std::string& text);

/// Tags from a file with a line for each, as parse_tag() has it; # begins a comment. The error says
/// file and line.
Result<std::vector<align::PrintedTag>> read_tags(const std::filesystem::path& file);

/// Error: an id given twice.
Result<> check_tags(const std::vector<align::PrintedTag>& tags);

}  // namespace orbwatch::app::cli
