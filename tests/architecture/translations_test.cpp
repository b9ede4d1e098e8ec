// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/manual_sections.h"
#include "tests/architecture/markdown_files.h"

/// The installer's manuals exist in the page's languages and translate the present English text.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kProject = ORBWATCH_SOURCE_DIR;
const fs::path kTexts = kProject / "app/ports/web/page/files/texts";

/// Manuals for an installer at the machine.
const std::set<fs::path> kManuals{"app/ports/web/COMMISSIONING.md", "platform/INSTALL.md",
                                  "platform/config/GIGE.md"};

std::string read_manual(const fs::path& file) {
  std::ifstream in(kProject / file);
  EXPECT_TRUE(in) << file << " is missing";
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Languages of the page, "de" for `de.js`.
std::set<std::string> languages_of_the_page() {
  std::set<std::string> languages;
  for (const auto& entry : fs::directory_iterator(kTexts)) {
    const std::string name = entry.path().stem();
    if (name.size() == 2) languages.insert(name);
  }
  return languages;
}

std::set<std::string> foreign_languages() {
  std::set<std::string> languages = languages_of_the_page();
  languages.erase("en");
  return languages;
}

fs::path translation_of(fs::path manual, const std::string& language) {
  return manual.replace_extension("." + language + ".md");
}

TEST(Translations, AreCompleteAndNotStale) {
  ASSERT_FALSE(foreign_languages().empty());
  for (const fs::path& manual : kManuals) {
    const auto english = sections_of(read_manual(manual));
    for (const std::string& language : foreign_languages()) {
      const fs::path file = translation_of(manual, language);
      for (const std::string& fault :
           faults_of_translation(english, sections_of(read_manual(file)))) {
        ADD_FAILURE() << file.string() << ": " << fault;
      }
    }
  }
}

TEST(Translations, ExistOfTheInstallersManualsOnly) {
  for (const fs::path& file : markdown_files()) {
    const std::string name = file.filename();
    if (english_name(name) == name) continue;
    const fs::path english = fs::relative(file.parent_path(), kProject) / english_name(name);
    EXPECT_TRUE(kManuals.contains(english)) << file << " translates none of kManuals";
  }
}

TEST(Translations, EachManualLinksItsOtherLanguages) {
  for (const fs::path& manual : kManuals) {
    for (const std::string& own : languages_of_the_page()) {
      const fs::path file = own == "en" ? manual : translation_of(manual, own);
      const std::string text = read_manual(file);
      for (const std::string& other : languages_of_the_page()) {
        if (other == own) continue;
        const fs::path target = other == "en" ? manual : translation_of(manual, other);
        EXPECT_THAT(text, HasSubstr("](" + target.filename().string() + ")")) << file;
      }
    }
  }
}

TEST(Translations, LinkTranslatedNeighbours) {
  static const std::regex kLink(R"rx(\]\(([^)#]+)[^)]*\))rx");
  for (const fs::path& manual : kManuals) {
    for (const std::string& language : foreign_languages()) {
      const fs::path file = translation_of(manual, language);
      const std::string text = read_manual(file);
      for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
        const fs::path target = (file.parent_path() / (*link)[1].str()).lexically_normal();
        EXPECT_TRUE(target == manual || !kManuals.contains(target))
            << file << ": link " << translation_of((*link)[1].str(), language) << " instead of "
            << (*link)[1];
      }
    }
  }
}

/// Names of buttons, pages and cards in a manual: *Align*, in Japanese 「位置合わせ」 or 「…
/// の色」. An asterisk of a command is no mark.
std::vector<std::string> labels_of(const std::string& manual) {
  static const std::regex kCommands("```[^`]*```");
  const std::string text = std::regex_replace(manual, kCommands, "");
  static const std::regex kLabel(
      R"rx((?:^|[^*\\])\*([^*\s][^*]*)\*(?!\*)|「(?:… )?((?:(?!」).)+)」)rx");
  std::vector<std::string> labels;
  for (std::sregex_iterator it(text.begin(), text.end(), kLabel), end; it != end; ++it) {
    labels.push_back((*it)[1].matched ? (*it)[1] : (*it)[2]);
  }
  return labels;
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c);
  });
  return text;
}

/// Texts of the page in a language: `de.js`, `de_words.js`. The English titles of signals and codes
/// are in every file of words.
std::string texts_of_the_page(const std::string& language) {
  std::string texts;
  for (const auto& entry : fs::directory_iterator(kTexts)) {
    const std::string name = entry.path().stem();
    if (name == language || name.starts_with(language + "_") ||
        (language == "en" && name.ends_with("_words"))) {
      texts += read_manual(fs::relative(entry.path(), kProject));
    }
  }
  return lower_case(texts);
}

TEST(Translations, NameButtonsAsThePageDoes) {
  for (const std::string& language : languages_of_the_page()) {
    const std::string page = texts_of_the_page(language);
    int labels = 0;
    for (const fs::path& manual : kManuals) {
      const fs::path file = language == "en" ? manual : translation_of(manual, language);
      for (const ManualSection& section : sections_of(read_manual(file))) {
        for (const std::string& label : labels_of(section.text)) {
          EXPECT_THAT(page, HasSubstr(lower_case(label))) << file << ", " << section.heading;
          ++labels;
        }
      }
    }
    EXPECT_GT(labels, 20) << language;
  }
}

// Rules of the comparison, with manuals of a few lines.
class TranslationFaults : public testing::Test {
 protected:
  /// Translation of the manual with current comments.
  std::string current() const {
    return "# Handbuch\n" + comment_for(english[0]) + "\n`a` misst.\n## Teil\n" +
           comment_for(english[1]) + "\n```sh\nrun\n```\nmit [Bild](b.de.md)\n";
  }

  std::vector<std::string> faults(const std::string& translation) const {
    return faults_of_translation(english, sections_of(translation));
  }

  /// Faults of the current translation after one change.
  std::vector<std::string> faults_with(const std::string& part, const std::string& instead) const {
    std::string text = current();
    text.replace(text.find(part), part.size(), instead);
    return faults(text);
  }

  const std::vector<ManualSection> english =
      sections_of("# Manual\n`a` measures.\n## Part\n```sh\nrun\n```\nwith a [picture](b.md)\n");
};

TEST_F(TranslationFaults, ACurrentTranslationHasNone) { EXPECT_THAT(faults(current()), IsEmpty()); }

TEST_F(TranslationFaults, NewLineBreaksInEnglishCauseNone) {
  const auto wrapped = sections_of(
      "# Manual\n`a`\nmeasures.\n\n## Part\n```sh\nrun\n```\nwith a\n[picture](b.md)\n");
  EXPECT_THAT(faults_of_translation(wrapped, sections_of(current())), IsEmpty());
}

TEST_F(TranslationFaults, AMissingSectionIsNamedWithItsComment) {
  const std::string text = current().substr(0, current().find("## Teil"));
  EXPECT_THAT(faults(text), ElementsAre(AllOf(HasSubstr("\"Part\" must be translated"),
                                              HasSubstr(comment_for(english[1])))));
}

TEST_F(TranslationFaults, AnExtraSectionIsNamed) {
  EXPECT_THAT(faults(current() + "## Mehr\nText\n"),
              ElementsAre(HasSubstr("\"Mehr\" is not in the English manual")));
}

TEST_F(TranslationFaults, AStaleSectionIsNamedWithItsNewComment) {
  const auto changed =
      sections_of("# Manual\n`a` counts.\n## Part\n```sh\nrun\n```\nwith a [picture](b.md)\n");
  EXPECT_THAT(faults_of_translation(changed, sections_of(current())),
              ElementsAre(AllOf(HasSubstr("\"Handbuch\" is stale"), HasSubstr("\"Manual\""),
                                HasSubstr(comment_for(changed[0])))));
}

TEST_F(TranslationFaults, SectionsInAnotherOrderAreNamed) {
  const std::string text = current();
  const std::size_t part = text.find("## Teil");
  EXPECT_THAT(faults(text.substr(part) + text.substr(0, part)),
              ElementsAre(HasSubstr("\"Handbuch\" is out of order")));
}

TEST_F(TranslationFaults, CodeAndLinksMustBeTheEnglishOnes) {
  EXPECT_THAT(faults_with("\nrun\n", "\nlauf\n"), ElementsAre(HasSubstr("other blocks of code")));
  EXPECT_THAT(faults_with("`a`", "`b`"), ElementsAre(HasSubstr("lacks `a`"), HasSubstr("has `b`")));
  EXPECT_THAT(faults_with("b.de.md", "c.de.md"), ElementsAre(HasSubstr("other links or pictures")));
}

}  // namespace
}  // namespace orbwatch::tests
