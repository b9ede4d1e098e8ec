// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/configuration/configuration_files.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

template <class Visitor>
void visit(Visitor& v, ConfigurationFiles::Change& change) {
  v.required("files", change.files, "Names of the files that differ");
  v.required("difference", change.difference, "Differing lines, with - before and + after");
}

}  // namespace orbwatch::app

/// Bodies and answers of ConfigurationDesk.
namespace orbwatch::app::web {

/// New texts. A check ignores the seconds.
struct ConfigurationBody {
  ConfigurationFiles::Edit edit;
  int seconds = kUsualTrial;
};
template <class Visitor>
void visit_seconds(Visitor& v, int& seconds) {
  v.optional("seconds", seconds, Range::between(kShortestTrial, kLongestTrial),
             "Time until the trial is reverted unless it is confirmed", "s");
}
template <class Visitor>
void visit(Visitor& v, ConfigurationBody& body) {
  v.required("files", body.edit.texts, "New texts by file name, for the files to change");
  v.optional(
      "based_on", body.edit.based_on,
      "Checksums of files as GET /api/v1/configuration returned them: 409 if one was changed "
      "since then, with user and time");
  visit_seconds(v, body.seconds);
}

struct FileAnswer {
  std::string name;
  bool may_change = false;
  std::string text;
  std::optional<std::string> checksum;
};
template <class Visitor>
void visit(Visitor& v, FileAnswer& file) {
  v.required("name", file.name, "Path relative to the folder of the configuration file");
  v.required("may_change", file.may_change, "A new text may be sent");
  v.required("text", file.text, "Content; bytes that are not UTF-8 are replaced");
  v.optional("checksum", file.checksum, "Checksum of a file of the configuration");
}

struct TrialState {
  ConfigurationFiles::Texts files;
  std::optional<double> seconds_left;
  std::string owner;
};
template <class Visitor>
void visit(Visitor& v, TrialState& trial) {
  v.required("files", trial.files, "Texts on trial by file name");
  v.required("seconds_left", trial.seconds_left, "Until it is reverted; null: not running yet",
             "s");
  v.required("owner", trial.owner, "User who started it; empty: it was started on the board");
}

struct ConfigurationAnswer {
  std::string site;
  std::vector<FileAnswer> files;
  std::string refusal;
  std::optional<TrialState> trial;
};
template <class Visitor>
void visit(Visitor& v, ConfigurationAnswer& answer) {
  v.required("site", answer.site, "Name of the configuration file");
  v.required("files", answer.files, "Files on the disk");
  v.required("refusal", answer.refusal,
             "Reason why the last good files run instead; empty: these files run");
  v.required("trial", answer.trial, "Trial that runs or waits; null: none");
}

struct TrialAnswer {
  ConfigurationFiles::Change change;
  int seconds = 0;
};
template <class Visitor>
void visit(Visitor& v, TrialAnswer& answer) {
  visit(v, answer.change);
  v.required("seconds", answer.seconds, "Time of the trial", "s");
}

struct ConfirmedAnswer {
  std::vector<std::string> files;
};
template <class Visitor>
void visit(Visitor& v, ConfirmedAnswer& answer) {
  v.required("files", answer.files, "Names of the written files");
}

}  // namespace orbwatch::app::web
