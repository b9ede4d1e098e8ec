// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

namespace orbwatch::tests {

/// Section of a manual: a heading and its text up to the next heading.
struct ManualSection {
  std::string heading;
  std::string source;                ///< translated English heading, by the comment; empty: none
  std::string source_checksum;       ///< checksum of the English text, by the comment
  std::string text;                  ///< heading and text without the comment, single spaces
  std::string code_blocks;           ///< with their fences
  std::set<std::string> code;        ///< code in sentences
  std::multiset<std::string> links;  ///< English names that links and pictures lead to
};

std::vector<ManualSection> sections_of(const std::string& manual);

/// Eight hexadecimal digits (FNV-1a) of the section's text; new line breaks do not change them.
std::string checksum_of(const ManualSection& section);

/// Comment that a translation of the English section has below its heading.
std::string comment_for(const ManualSection& english);

/// "INSTALL.de.md" -> "INSTALL.md"; other names stay.
std::string english_name(const std::string& file);

/// Faults of a translation, each with its section and the remedy.
std::vector<std::string> faults_of_translation(const std::vector<ManualSection>& english,
                                               const std::vector<ManualSection>& translation);

}  // namespace orbwatch::tests
