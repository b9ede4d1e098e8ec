// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// Checks that Python's parser reads the same from both documents.
inline void expect_equal_json(const std::string& text, const std::string& expected) {
  constexpr const char* kCompare = R"(
import json, sys
a, b = (json.loads(open(f, 'rb').read().decode('utf-8')) for f in sys.argv[1:])
sys.exit(0 if a == b else 'differs: %r' % (a,))
)";
  const TemporaryFolder folder;
  std::ofstream(folder / "text", std::ios::binary) << text;
  std::ofstream(folder / "expected", std::ios::binary) << expected;
  Subprocess python({"/usr/bin/python3", "-c", kCompare, (folder / "text").string(),
                     (folder / "expected").string()},
                    folder / "said");
  EXPECT_EQ(python.wait(), 0) << python.output() << text;
}

}  // namespace orbwatch::tests
