// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/dds_sink.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/log.h"
#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {
namespace {

/// Period of the checks of the host's addresses.
constexpr auto kCheckPeriod = std::chrono::seconds(1);

/// An address by which other computers reach this one; empty: none.
std::string reachable(const std::set<std::string>& addresses) {
  const auto other = std::ranges::find_if(
      addresses, [](const std::string& address) { return !address.starts_with("127."); });
  if (other != addresses.end()) return *other;
  return addresses.empty() ? "" : *addresses.begin();
}

}  // namespace

DdsSink::DdsSink(DdsSettings settings, StatusNames names, CommandHandler handler,
                 Addresses addresses, std::shared_ptr<CommandRecord> record,
                 const std::shared_ptr<hal::SharedThreads>& threads, ApplianceIdentity identity,
                 std::shared_ptr<Fleet> fleet, std::vector<PublishedView> views,
                 std::vector<PublishedCamera> cameras, MachinePath machine)
    : settings_(std::move(settings)),
      names_(std::move(names)),
      threads_(threads),
      addresses_(std::move(addresses)),
      selected_(image_topic(settings_.prefix, kSelectedView), PixelFormat::Rgb, settings_.jpeg,
                threads),
      selected_info_(image_topic(settings_.prefix, kSelectedView)),
      status_topics_(settings_.prefix, names_),
      fleet_(std::move(identity), std::move(fleet), threads),
      takes_commands_(takes_commands(settings_) && handler),
      record_(std::move(record)),
      commands_(settings_.prefix, std::move(handler), *record_) {
  if (machine.source == MachineSource::Dds) {
    machine_.emplace(settings_.prefix, std::move(machine));
  }
  views.resize(names_.views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    views_.push_back(std::make_unique<ViewTopics>(settings_, names_.views[i], views[i], threads));
  }
  cameras.resize(names_.cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    cameras_.push_back(
        std::make_unique<CameraTopics>(settings_, names_.cameras[i], cameras[i], threads));
  }
}

DdsSink::~DdsSink() { stop(); }

Result<> DdsSink::start() {
  if (!settings_.enabled || thread_.is_running()) return {};
  limit_dds_log();
  if (const auto checked = check(); !checked) return checked;
  next_check_ = {};
  next_try_ = {};
  tried_addresses_.clear();
  back_off_.reset();
  running_ = true;
  keep_joined();
  thread_.start("dds", [this] { run(); });
  return {};
}

void DdsSink::stop() {
  running_ = false;
  thread_.stop();
  leave();
  statuses_.discard();
  while (notices_.try_take()) {
  }
}

Result<> DdsSink::check() const {
  if (const auto checked = check_domain(settings_.domain); !checked) return checked;
  if (const auto checked = check_settings(settings_); !checked) return checked;
  if (settings_.security) {
    const auto secured = security_qos(*settings_.security, settings_.domain);
    if (!secured) return tl::unexpected(secured.error());
  }
  for (auto name = names_.views.begin(); name != names_.views.end(); ++name) {
    if (const auto checked = check_topic_part(*name, "view name"); !checked) return checked;
    if (*name == kSelectedView || std::find(names_.views.begin(), name, *name) != name) {
      return fail("DDS: view name \"" + *name +
                  "\" is already used; set a different name for each view");
    }
  }
  for (const auto& name : names_.cameras) {
    if (const auto checked = check_topic_part(name, "camera name"); !checked) return checked;
  }
  return {};
}

Result<> DdsSink::join() {
  auto participant = Participant::join(settings_.domain, settings_.security, kParticipantUserData,
                                       settings_.profile);
  if (!participant) return tl::unexpected(participant.error());
  participant_ = std::move(*participant);
  const Entity& entity = participant_.entity();
  for (const auto& view : views_) {
    if (const auto opened = view->open(entity); !opened) return opened;
  }
  for (const auto& camera : cameras_) {
    if (const auto opened = camera->open(entity); !opened) return opened;
  }
  fleet_.open(entity, reachable(participant_.addresses()));
  return selected_.open(entity)
      .and_then([&] { return selected_info_.open(entity); })
      .and_then([&] { return status_topics_.open(entity); })
      .and_then([&] { return takes_commands_ ? commands_.open(entity) : Result<>(); })
      .and_then([&] { return open_machine(); })
      .and_then([&] { return discovery_.open(entity, settings_.ros); })
      .and_then([&] { return announce_node(); })
      .and_then([&] { return watch_types(); });
}

/// Keys of an earlier version do not permit this topic; they leave the others. Other errors fail
/// the attempt to join, which is repeated.
Result<> DdsSink::open_machine() {
  if (!machine_) return {};
  const auto opened = machine_->open(participant_.entity());
  if (opened || !is_refused_by_security(opened.error())) return opened;
  machine_->close();
  log_line(LogLevel::Warning,
           opened.error().message +
               "; no states of the machine are received. Keys of an earlier version do not permit "
               "machine_state: `orbwatch dds-keys` makes new ones");
  return {};
}

std::chrono::nanoseconds DdsSink::cpu_time() const {
  std::chrono::nanoseconds time =
      thread_.cpu_time() + commands_.cpu_time() + selected_.cpu_time() + fleet_.cpu_time();
  for (const auto& view : views_) time += view->cpu_time();
  for (const auto& camera : cameras_) time += camera->cpu_time();
  return time;
}

std::vector<const TopicWriter*> DdsSink::writers() const {
  std::vector<const TopicWriter*> all;
  const auto add = [&all](const std::vector<const TopicWriter*>& writers) {
    all.insert(all.end(), writers.begin(), writers.end());
  };
  for (const auto& view : views_) add(view->writers());
  for (const auto& camera : cameras_) add(camera->writers());
  add(selected_.writers());
  add({&selected_info_.writer()});
  add(status_topics_.writers());
  add(fleet_.writers());
  if (takes_commands_) add({&commands_.results()});
  return all;
}

std::vector<const TopicReader*> DdsSink::readers() const {
  std::vector<const TopicReader*> all;
  if (takes_commands_) all.push_back(&commands_.requests());
  if (machine_ && machine_->is_open()) all.push_back(&machine_->states());
  return all;
}

Result<> DdsSink::announce_node() {
  std::vector<dds_entity_t> written, read;
  for (const TopicWriter* writer : writers()) written.push_back(writer->get());
  for (const TopicReader* reader : readers()) read.push_back(reader->get());
  return discovery_.announce(written, read);
}

Result<> DdsSink::watch_types() {
  std::map<std::string, std::string> types;
  for (const TopicWriter* writer : writers()) types[writer->name()] = writer->type_name();
  for (const TopicReader* reader : readers()) types[reader->name()] = reader->type_name();
  return type_watch_.open(participant_.entity(), std::move(types));
}

void DdsSink::leave() {
  joined_ = false;
  interfaces_.left();
  type_watch_.close();
  discovery_.close();
  commands_.close();
  if (machine_) machine_->close();
  for (const auto& view : views_) view->close();  // before selected_, because they write to it, too
  for (const auto& camera : cameras_) camera->close();
  selected_.close();
  selected_info_.close();
  status_topics_.close();
  fleet_.close();
  participant_.leave();
}

void DdsSink::keep_joined() {
  const auto now = hal::Clock::now();
  if (now < next_check_) return;
  next_check_ = now + kCheckPeriod;
  mistyped_ = type_watch_.update();
  const auto addresses = addresses_();
  const bool changed = addresses && interfaces_.is_change(tried_addresses_, *addresses);
  if (joined_ ? !changed : !changed && now < next_try_) return;
  if (joined_) {
    log_line(LogLevel::Warning,
             "DDS: the addresses of its network changed, joins the domain again");
    leave();
  }
  if (changed) {
    back_off_.reset();
    tried_addresses_ = *addresses;
  }
  if (const auto joined = join(); !joined) {
    leave();
    next_try_ = now + back_off_.next();
    const std::string& refusal = joined.error().message;
    if (refusal != refusal_) log_line(LogLevel::Warning, refusal + "; tries again");
    refusal_ = refusal;
    return;
  }
  if (!std::exchange(refusal_, {}).empty()) log_line(LogLevel::Info, "DDS: joined the domain");
  interfaces_.joined(tried_addresses_, participant_.addresses());
  joined_ = true;
  ++joins_;
}

TimeMessage DdsSink::utc(hal::TimePoint stamp) {
  if (stamp != stamp_) {
    stamp_ = stamp;
    utc_ = hal::to_utc(stamp);
  }
  return to_message(utc_);
}

void DdsSink::accept_frames(const hal::FrameSet& set) {
  if (!running_) return;
  utc(set.stamp);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const hal::Frame& frame = set.frames[i];
    if (!frame || set.held[i]) continue;
    // Converted with the set's offset, so that a frame exposed with the set has the stamp of its
    // views.
    const auto exposed = utc_ + (frame->metadata.exposure_start - set.stamp);
    cameras_[i]->accept(frame, to_message(exposed));
  }
}

PictureNeeds DdsSink::needs(std::size_t view, hal::TimePoint stamp) {
  if (!running_ || view >= views_.size()) return {};
  PictureNeeds needs = views_[view]->ask(utc(stamp));
  if (view == selected_view_) needs |= selected_.ask(utc(stamp)) |= fleet_.needs(utc(stamp));
  return needs;
}

/// All topics of a view hold the same view unless their rate is limited. Views that wait to be
/// written as the selected view, or as the thumbnail, may belong to the view selected before.
KeptViews DdsSink::keeps() const {
  const std::size_t waiting = PictureTopics::waiting(settings_.jpeg);
  return {waiting, waiting + 1 + threads_->count()};
}

void DdsSink::accept(const ViewPtr& view) {
  if (!running_) return;
  if (view->index >= views_.size()) {
    ++unknown_views_;
    return;
  }
  ViewTopics& topics = *views_[view->index];
  const StampedPicture picture{view, view->picture, utc(view->stamp), &topics.name()};
  const bool is_selected = view->index == selected_view_;
  bool has_info = topics.accept(view, picture, is_selected ? &selected_ : nullptr);
  if (is_selected) {
    fleet_.accept(picture);
    if (view->spec.kind == optics::ViewKind::Perspective &&
        selected_info_.accept({view->spec, picture.stamp, &topics.name()})) {
      has_info = true;
    }
  }
  // Before the next status this view may come again and replace its info.
  if (has_info) thread_.wake();
}

void DdsSink::accept(const Status& status) {
  if (!running_) return;
  selected_view_ = status.selected_view;
  statuses_.put({status, status.frame_set == 0 ? TimeMessage{} : utc(status.stamp)});
  thread_.wake();
}

void DdsSink::accept_event(const AlarmNotice& notice) {
  if (!running_) return;
  notices_.put({notice, utc(notice.stamp)});
  thread_.wake();
}

void DdsSink::run() {
  while (thread_.wait()) {
    keep_joined();
    if (!joined_) continue;
    while (const auto notice = notices_.try_take()) status_topics_.publish(*notice);
    for (const auto& view : views_) view->publish_info();
    for (const auto& camera : cameras_) camera->publish_info();
    selected_info_.publish();
    statuses_.take([this](const StampedStatus& status) { publish(status); });
  }
}

void DdsSink::publish(const StampedStatus& status) {
  status_topics_.publish(status, commands_.counts(), [this] { return statistics(); });
  fleet_.publish({status.status, names_, hal::Clock::now(), to_utc(status.stamp)});
}

DdsStatistics DdsSink::statistics() const {
  DdsStatistics statistics;
  for (const auto& view : views_) view->report(statistics.topics);
  for (const auto& camera : cameras_) camera->report(statistics.topics);
  selected_.report(statistics.topics);
  statistics.topics.push_back(selected_info_.statistics());
  for (const TopicWriter* topic : status_topics_.writers()) {
    statistics.topics.push_back(topic->statistics());
  }
  fleet_.report(statistics.topics);
  statistics.topics.push_back(commands_.results().statistics());
  statistics.joins = joins_;
  statistics.dropped_states = statuses_.drops();
  statistics.dropped_events = notices_.drops();
  statistics.commands = commands_.counts();
  statistics.unknown_views = unknown_views_;
  statistics.mistyped = mistyped_;
  statistics.malformed = malformed_samples();
  return statistics;
}

std::vector<InterfaceTable> DdsSink::tables() const {
  InterfaceTable topics{"dds", "topics", {"topic"}, {}};
  for_each_field(std::type_identity<TopicStatistics>{},
                 [&topics](const FieldInfo& field) { topics.columns.emplace_back(field.name); });
  topics.columns.emplace_back("last_error");
  for (const TopicStatistics& topic : statistics().topics) {
    auto& row = topics.rows.emplace_back();
    row.emplace_back(topic.topic);
    for_each_reading(topic, {},
                     [&row](const Reading& reading) { row.emplace_back(reading.value); });
    row.emplace_back(topic.last_error);
  }
  return {std::move(topics)};
}

std::vector<InterfaceMetric> DdsSink::metrics() const {
  const DdsStatistics statistics = this->statistics();
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"dds"}, static_cast<const DdsCounts&>(statistics), {});
  add_metrics(all, {"dds_commands"}, statistics.commands, {});
  for (const TopicStatistics& topic : statistics.topics) {
    add_metrics(all, {"dds_topic", topic.topic}, topic, {});
  }
  return all;
}

}  // namespace orbwatch::app::dds

namespace orbwatch::app {

std::string commanders(const DdsSettings& settings) {
  if (!takes_commands(settings)) return {};
  return "over DDS from " +
         (settings.security ? std::string("holders of keys")
                            : "every participant of domain " + std::to_string(settings.domain));
}

Result<> check_settings(const DdsSettings& settings) {
  if (!settings.enabled) return {};
  return dds::check_topic_path(settings.prefix, "prefix").and_then([&] {
    return dds::check_profile(settings.profile);
  });
}

std::unique_ptr<Sink> make_sink(const DdsSettings& settings, const StatusNames& names,
                                const std::vector<PublishedView>& views,
                                const std::vector<PublishedCamera>& cameras,
                                const CommandPath& commands,
                                const std::shared_ptr<hal::SharedThreads>& background,
                                const ApplianceIdentity& identity,
                                const std::shared_ptr<Fleet>& fleet, const MachinePath& machine) {
  if (!settings.enabled) return nullptr;
  ApplianceIdentity own = identity;
  own.name = settings.name;
  own.prefix = settings.prefix;
  return std::make_unique<dds::DdsSink>(settings, names, commands.handler, dds::network_addresses,
                                        commands.record, background, std::move(own), fleet, views,
                                        cameras, machine);
}

}  // namespace orbwatch::app
