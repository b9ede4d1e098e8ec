// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/manual_sections.h"

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <iterator>
#include <regex>
#include <sstream>

namespace orbwatch::tests {
namespace {

std::string single_spaces(const std::string& text) {
  std::istringstream in(text);
  std::string joined;
  for (std::string word; in >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

/// Reads the sentences of a section, once they are complete.
void read_sentences(ManualSection& section, const std::string& sentences) {
  static const std::regex kCode("`([^`]+)`");
  static const std::regex kLink(R"rx(\]\(([^)#]*)[^)]*\))rx");
  for (std::sregex_iterator it(sentences.begin(), sentences.end(), kCode), end; it != end; ++it) {
    section.code.insert(single_spaces((*it)[1]));
  }
  for (std::sregex_iterator it(sentences.begin(), sentences.end(), kLink), end; it != end; ++it) {
    section.links.insert(english_name((*it)[1]));
  }
}

class ManualReader {
 public:
  void add_line(const std::string& line) {
    static const std::regex kHeading("#{1,6} (.*)");
    std::smatch found;
    const bool is_fence = line.starts_with("```");
    if (is_fence || is_block_) {
      section_.code_blocks += line + "\n";
      is_block_ = is_fence ? !is_block_ : is_block_;
    } else if (std::regex_match(line, found, kHeading)) {
      end_section();
      section_.heading = found[1];
    } else if (add_comment(line)) {
      return;
    } else {
      sentences_ += line + "\n";
    }
    section_.text += line + "\n";
  }

  std::vector<ManualSection> sections() && {
    end_section();
    return std::move(sections_);
  }

 private:
  bool add_comment(const std::string& line) {
    static const std::regex kComment("<!-- English: (.*) ([0-9a-f]{8}) -->");
    std::smatch found;
    if (!std::regex_match(line, found, kComment)) return false;
    section_.source = found[1];
    section_.source_checksum = found[2];
    return true;
  }

  void end_section() {
    section_.text = single_spaces(section_.text);
    read_sentences(section_, sentences_);
    if (!section_.text.empty()) sections_.push_back(std::move(section_));
    section_ = {};
    sentences_.clear();
  }

  std::vector<ManualSection> sections_;
  ManualSection section_;
  std::string sentences_;
  bool is_block_ = false;
};

std::string named(const std::string& heading) { return "section \"" + heading + "\""; }

std::string list_of(const std::vector<std::string>& codes) {
  std::string list;
  for (const std::string& code : codes) list.append(list.empty() ? "`" : ", `").append(code) += '`';
  return list;
}

/// Faults of the code in one section's sentences against the English one.
void compare_code(const ManualSection& english, const ManualSection& section,
                  std::vector<std::string>& faults) {
  std::vector<std::string> lacking;
  std::vector<std::string> added;
  std::ranges::set_difference(english.code, section.code, std::back_inserter(lacking));
  std::ranges::set_difference(section.code, english.code, std::back_inserter(added));
  if (!lacking.empty()) {
    faults.push_back(named(section.heading) + " lacks " + list_of(lacking) +
                     ": add it as in English");
  }
  if (!added.empty()) {
    faults.push_back(named(section.heading) + " has " + list_of(added) +
                     ", which is not in English: remove it, or add it there");
  }
}

/// Faults of one section against the English one that it translates.
void compare_sections(const ManualSection& english, const ManualSection& section,
                      std::vector<std::string>& faults) {
  const std::string name = named(section.heading);
  if (section.source_checksum != checksum_of(english)) {
    faults.push_back(name + " is stale: translate what changed in " + named(english.heading) +
                     ", then set its comment to " + comment_for(english));
  }
  if (section.code_blocks != english.code_blocks) {
    faults.push_back(name + " has other blocks of code than " + named(english.heading) +
                     ": copy the English ones");
  }
  compare_code(english, section, faults);
  if (section.links != english.links) {
    faults.push_back(name + " has other links or pictures than " + named(english.heading) +
                     ": copy the English ones");
  }
}

}  // namespace

std::vector<ManualSection> sections_of(const std::string& manual) {
  std::istringstream in(manual);
  ManualReader reader;
  for (std::string line; std::getline(in, line);) reader.add_line(line);
  return std::move(reader).sections();
}

std::string checksum_of(const ManualSection& section) {
  std::uint32_t hash = 2166136261U;
  for (const char c : section.text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  std::ostringstream digits;
  digits << std::hex << std::setfill('0') << std::setw(8) << hash;
  return digits.str();
}

std::string comment_for(const ManualSection& english) {
  return "<!-- English: " + english.heading + " " + checksum_of(english) + " -->";
}

std::string english_name(const std::string& file) {
  static const std::regex kTranslation(R"((.*)\.[a-z]{2}\.md)");
  return std::regex_replace(file, kTranslation, "$1.md");
}

std::vector<std::string> faults_of_translation(const std::vector<ManualSection>& english,
                                               const std::vector<ManualSection>& translation) {
  std::vector<std::string> faults;
  for (const ManualSection& original : english) {
    if (std::ranges::count(translation, original.heading, &ManualSection::source) != 1) {
      faults.push_back(named(original.heading) +
                       " must be translated once: begin its translation, below the heading, with " +
                       comment_for(original));
    }
  }
  auto next = english.begin();
  for (const ManualSection& section : translation) {
    const auto original = std::ranges::find(english, section.source, &ManualSection::heading);
    if (original == english.end()) {
      faults.push_back(named(section.heading) +
                       " is not in the English manual: remove it, or state below its heading "
                       "what it translates: <!-- English: HEADING CHECKSUM -->");
      continue;
    }
    if (original < next) {
      faults.push_back(named(section.heading) + " is out of order: move it to its English place");
    }
    next = original;
    compare_sections(*original, section, faults);
  }
  return faults;
}

}  // namespace orbwatch::tests
