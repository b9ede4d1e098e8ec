// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace orbwatch::tests {

/// Command line in a README.
struct ReadmeCommand {
  std::string place;       ///< "README.md:48"
  std::string text;        ///< text without a comment
  bool is_inline = false;  ///< in a sentence, else a line of a block
};

/// The command lines of a page: the lines of its blocks marked `sh` or `bash`, and code in its
/// sentences that begins with orbwatch, orbwatchd or sudo and one of them. A command in a block
/// that is not marked is a failure of the test.
std::vector<ReadmeCommand> commands_of(const std::string& page);

}  // namespace orbwatch::tests
