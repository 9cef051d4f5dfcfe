#include "room.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "nest_job.hpp"

namespace lekalo::server {
namespace {

using io::JsonWriter;
using layout::Placement;
using layout::PlacementChange;

std::uint64_t id_of(const PlacementChange& change) {
  return change.after ? change.after->id : change.before->id;
}

/// The message of a type; its object is open.
JsonWriter begin_message(const char* type) {
  JsonWriter json(io::JsonLayout::spaced);
  json.begin_object().field("type", type);
  return json;
}

std::string end_message(JsonWriter& json) {
  json.end();
  return json.take();
}

void write_placements(JsonWriter& json, const layout::Document& document, const layout::Change& change) {
  json.key("placements").list(change.placements, [&](const PlacementChange& one) {
    json.begin_object().field("id", id_of(one)).key("after");
    one.after ? void(json.raw() += io::placement_json(document, *one.after)) : void(json.value(nullptr));
    json.end();
  });
}

void write_features(JsonWriter& json, const layout::Document& document, const layout::Change& change) {
  json.key("features").raw() += io::features_json(document, change.features);
}

std::vector<Placement> placed_by(const layout::Change& change) {
  std::vector<Placement> placed;
  for (const PlacementChange& one : change.placements)
    if (one.after) placed.push_back(*one.after);
  return placed;
}

/// The key of a feature among the last changes.
std::string feature_key(const std::string& stock, const layout::Feature& feature) {
  return fmt::format("{} {} {}", static_cast<int>(feature.kind), feature.id, stock);
}

/// The id of a stock that a change names, after it was carried out.
std::string stock_id(const layout::Document& after, const layout::Change& change, std::uint32_t number) {
  std::uint32_t gone = 0;
  for (const auto& one : change.job.stocks) {
    if (one.after || one.index > number) continue;
    if (one.index == number) return one.before->id;
    ++gone;
  }
  return after.stocks[number - gone].id;
}

/// The item that a change of the job changes, in words; the key among the last changes too.
std::string named(const layout::ItemChange<layout::Part>& one) {
  return fmt::format("part '{}'", one.either().id);
}
std::string named(const layout::ItemChange<layout::Stock>& one) {
  return fmt::format("stock '{}'", one.either().id);
}
std::string named(const layout::ItemChange<layout::Kit>& one) {
  return fmt::format("kit '{}'", one.either().id);
}
constexpr const char* kRules = "the rules";

/// Names the kits that a command changes and that stay, or those that go.
void name_kits(JsonWriter& json, const char* key, const std::vector<layout::ItemChange<layout::Kit>>& kits,
               bool stay) {
  std::vector<std::string> ids;
  for (const auto& one : kits)
    if (one.after.has_value() == stay) ids.push_back(one.either().id);
  if (!ids.empty()) json.key(key).list(ids, [&](const std::string& id) { json.value(id); });
}

std::int64_t taken_off(const layout::Change& change) {
  if (change.job.is_nothing()) return 0;
  return std::count_if(change.placements.begin(), change.placements.end(),
                       [](const PlacementChange& one) { return !one.after; });
}

/// The first change of a list that does not find what it was made for; none where all do.
template <class Item>
const layout::ItemChange<Item>* unfit(const std::vector<Item>& there,
                                      const std::vector<layout::ItemChange<Item>>& changes) {
  std::uint32_t come = 0;
  for (const layout::ItemChange<Item>& one : changes) {
    if (one.before) {
      if (!(there[one.index - come] == *one.before)) return &one;
      continue;
    }
    ++come;
    const auto same_id = [&](const auto& other) { return other.id == one.after->id; };
    const auto goes = [&](const layout::ItemChange<Item>& other) {
      return other.before && !other.after && same_id(*other.before);
    };
    if (std::any_of(there.begin(), there.end(), same_id) &&
        std::none_of(changes.begin(), changes.end(), goes))
      return &one;
  }
  return nullptr;
}

template <class Item>
std::set<std::string> ids_that_go(const std::vector<layout::ItemChange<Item>>& changes) {
  std::set<std::string> ids;
  for (const layout::ItemChange<Item>& one : changes)
    if (!one.after) ids.insert(one.before->id);
  return ids;
}

/// A command in a sentence: the outlines in some are long.
std::string brief(const std::string& text) {
  constexpr std::size_t kMost = 100;
  if (text.size() <= kMost) return text;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + " ...";
}

/// The violations of all parts with the features that a change leaves behind. \pre carried out
std::vector<layout::Violation> violations_with(const layout::Workspace& workspace,
                                               const layout::Change& change) {
  std::vector<layout::Violation> all;
  for (const layout::FeatureChange& one : change.features) {
    if (!one.after) continue;
    const auto index = find_feature(workspace.document().stocks[one.stock], one.after->kind, one.after->id);
    if (!index) continue;  // a later change of the same list took it
    const auto some = workspace.violations_with(one.stock, one.after->kind, *index);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Outgoing message(ClientNumber to, std::string text, Loss loss = Loss::never) {
  return {to, std::make_shared<const std::string>(std::move(text)), loss};
}

std::string refused(std::uint64_t seq, const std::string& why, const std::string& violations = "[]") {
  JsonWriter json = begin_message("refused");
  json.fields({{"seq", seq}, {"message", why}}).key("violations").raw() += violations;
  return end_message(json);
}

JsonWriter begin_done(std::uint64_t seq, Revision revision) {
  JsonWriter json = begin_message("done");
  json.fields({{"seq", seq}, {"revision", revision}});
  return json;
}

/// The violations that a command refused in strict mode would make, to be shown.
std::string violations_of_refused(const layout::Workspace& workspace, const layout::Command& command) {
  if (job_of(command, layout::Mode::free)) return "[]";  // takes too long to be tried again for this
  const Result<layout::Change> free = layout::plan(workspace, command, layout::Mode::free);
  if (!free) return "[]";
  const std::vector<Placement> placed = placed_by(*free);
  // Measuring one overlap takes milliseconds; with many parts everyone here would wait for seconds.
  constexpr std::size_t kMostMeasured = 100;
  const auto depths = placed.size() > kMostMeasured ? layout::Depths::left_out : layout::Depths::measured;
  return io::violations_json(workspace.document(), workspace.violations_of(placed, depths));
}

}  // namespace

Room::Room(Store& store, LayoutId id, StoredLayout layout)
    : store_(store),
      id_(id),
      name_(std::move(layout.name)),
      revision_(layout.revision),
      workspace_(std::move(layout.document)) {}

Result<Outbound> Room::join(ClientNumber client, const std::string& author) {
  if (removed_) return failure(ErrorCode::usage, "the layout was deleted");
  if (!author.empty() && stacks_.find(author) == stacks_.end()) {
    LEKALO_TRY(const std::vector<HistoryEntry> history, store_.history(id_));
    Stack& stack = stacks_[author];
    for (const HistoryEntry& entry : history) {
      if (entry.author != author) continue;
      if (entry.kind == ChangeKind::command) {
        stack.done.push_back(entry.revision);
        stack.undone.clear();
      } else if (entry.kind == ChangeKind::undo && !stack.done.empty()) {
        stack.undone.push_back(stack.done.back());
        stack.done.pop_back();
      } else if (entry.kind == ChangeKind::redo && !stack.undone.empty()) {
        stack.done.push_back(stack.undone.back());
        stack.undone.pop_back();
      }
    }
  }
  clients_[client].author = author;
  Outbound out;
  out.push_back(message(client, layout_text(client, io::write_layout(document())), Loss::fresh));
  out.push_back(message(client, selections_text(), Loss::as_newer));
  return out;
}

Outbound Room::leave(ClientNumber client) {
  Outbound out;
  const auto at = clients_.find(client);
  if (at == clients_.end()) return out;
  const bool selected = !at->second.selected.empty();
  clients_.erase(at);
  for (auto& [number, running] : running_)  // nobody waits for it any more
    if (running.client == client) *running.stop = true;
  if (selected) to_all(selections_text(), Loss::as_newer, out);
  return out;
}

std::vector<ClientNumber> Room::clients() const {
  std::vector<ClientNumber> numbers;
  for (const auto& one : clients_) numbers.push_back(one.first);
  return numbers;
}

Outbound Room::handle(ClientNumber client, const ClientMessage& said, const std::atomic<bool>& gone) {
  if (clients_.find(client) == clients_.end()) return {};
  if (const auto* one = std::get_if<CommandMessage>(&said)) return command(client, *one, gone);
  if (const auto* one = std::get_if<UndoMessage>(&said)) return undo(client, *one);
  if (const auto* one = std::get_if<StopMessage>(&said)) {
    stop(client, *one);
    return {};
  }
  return select(client, std::get<SelectMessage>(said));
}

Outbound Room::resend(ClientNumber client) const {
  Outbound out;
  if (clients_.find(client) == clients_.end()) return out;
  out.push_back(message(client, layout_text(client, io::write_layout(document())), Loss::fresh));
  out.push_back(message(client, selections_text(), Loss::as_newer));
  return out;
}

Outbound Room::command(ClientNumber client, const CommandMessage& said, const std::atomic<bool>& gone) {
  Outbound out;
  Result<std::optional<Running>> running = read_long(client, said);
  if (!running) {
    out.push_back(message(client, refused(said.seq, running.error().message)));
    return out;
  }
  if (*running) {
    start(std::move(**running));
    return out;
  }
  const Result<layout::Command> command = layout::command_from_text(said.text, document());
  RunControl run;
  run.stop = &gone;
  std::string violations = "[]";
  auto planned = stoppable(run, [&] {
    Result<layout::Change> change = layout::plan(workspace_, *command, said.mode);
    if (!change && change.error().code == ErrorCode::refuted)
      violations = violations_of_refused(workspace_, *command);
    return change;
  });
  if (!planned) return out;
  Result<layout::Change>& change = *planned;
  if (change) return carry_out(client, said, to_text(*command, document()), std::move(*change));
  out.push_back(message(client, refused(said.seq, change.error().message, violations)));
  return out;
}

Result<std::optional<Room::Running>> Room::read_long(ClientNumber client, const CommandMessage& said) const {
  if (const auto nest = nest_request(said.text, document())) {
    if (!*nest) return tl::unexpected(nest->error());
    return Running{client, said, to_text(**nest), std::nullopt, job_of(**nest), last_job_change_};
  }
  LEKALO_TRY(const layout::Command command, layout::command_from_text(said.text, document()));
  if (std::optional<Job> job = job_of(command, said.mode))
    return Running{client, said, to_text(command, document()), command, std::move(*job), last_job_change_};
  return std::optional<Running>();
}

Outbound Room::carry_out(ClientNumber client, const CommandMessage& said, const std::string& text,
                         layout::Change change, bool stopped) {
  Outbound out;
  if (said.preview && !change.job.is_nothing()) {
    out.push_back(
        message(client, refused(said.seq, "parts, stocks and rules are changed without a preview")));
    return out;
  }
  if (said.preview) {
    out.push_back(message(client, preview_text(said.seq, change)));
    return out;
  }
  if (change.is_nothing()) {
    JsonWriter json = begin_done(said.seq, revision_);
    json.field("nothing", true);
    if (stopped) json.field("stopped", true);
    out.push_back(message(client, end_message(json)));
    return out;
  }
  StoredChange stored;
  stored.mode = said.mode;
  stored.text = text + (stopped ? " # stopped early" : "");
  stored.change = change;
  if (Result<void> kept = commit(client, std::move(stored), out); !kept) {
    out.push_back(message(client, refused(said.seq, kept.error().message)));
    return out;
  }
  JsonWriter json = begin_done(said.seq, revision_);
  if (stopped) json.field("stopped", true);
  if (const std::int64_t count = taken_off(change); count > 0) json.field("taken_off", count);
  name_kits(json, "kits", change.job.kits, true);
  name_kits(json, "kits_gone", change.job.kits, false);
  // A defect is where it is: admitted, and what lies on it is named.
  if (!change.features.empty())
    json.key("violations").raw() += io::violations_json(document(), violations_with(workspace_, change));
  out.insert(out.begin(), message(client, end_message(json)));
  Stack& stack = stack_of(clients_[client]);
  stack.done.push_back(revision_);
  stack.undone.clear();
  return out;
}

void Room::start(Running running) {
  running.stop = std::make_shared<std::atomic<bool>>(false);
  ++running.attempts;
  const JobNumber number = ++last_job_;
  starting_.push_back({number, running.job, document(), running.stop});
  running_.emplace(number, std::move(running));
}

void Room::stop(ClientNumber client, const StopMessage& said) {
  for (auto& [number, running] : running_)
    if (running.client == client && running.said.seq == said.seq) *running.stop = true;
}

bool Room::is_busy(ClientNumber client) const {
  return std::any_of(running_.begin(), running_.end(),
                     [&](const auto& one) { return one.second.client == client; });
}

ClientNumber Room::client_of(JobNumber job) const {
  const auto at = running_.find(job);
  return at == running_.end() ? 0 : at->second.client;
}

std::vector<JobStart> Room::take_jobs() { return std::exchange(starting_, {}); }

Outbound Room::job_progress(JobNumber job, double fraction, std::optional<double> seconds_left) const {
  Outbound out;
  const auto at = running_.find(job);
  if (at == running_.end()) return out;
  JsonWriter json = begin_message("progress");
  json.field("seq", at->second.said.seq).key("fraction").raw() += fmt::format("{:.4f}", fraction);
  json.key("seconds_left").raw() += seconds_left ? fmt::format("{:.1f}", *seconds_left) : "null";
  out.push_back(message(at->second.client, end_message(json), Loss::as_newer));
  return out;
}

Outbound Room::job_improved(JobNumber job, const layout::Change& change) const {
  Outbound out;
  const auto at = running_.find(job);
  if (at == running_.end()) return out;
  JsonWriter json = begin_message("improved");
  write_placements(json.field("seq", at->second.said.seq), document(), change);
  out.push_back(message(at->second.client, end_message(json), Loss::as_newer));
  return out;
}

std::optional<layout::Change> Room::rebased(const layout::Change& change, layout::Mode mode) const {
  layout::Change now;
  now.next_id_before = now.next_id_after = document().next_id;
  for (const PlacementChange& one : change.placements) {
    const Placement* const there = one.before ? workspace_.find(one.before->id) : nullptr;
    if (one.before && (there == nullptr || *there != *one.before)) return std::nullopt;
    now.placements.push_back(one);
    if (!one.before) now.placements.back().after->id = now.next_id_after++;
  }
  if (mode == layout::Mode::strict && !workspace_.is_clear(placed_by(now))) return std::nullopt;
  return now;
}

Outbound Room::job_ended(JobNumber job, const Result<layout::Change>& found) {
  Outbound out;
  auto node = running_.extract(job);
  if (node.empty() || clients_.find(node.mapped().client) == clients_.end()) return out;
  Running& running = node.mapped();
  const auto refuse = [&](const std::string& why, const std::string& violations = "[]") {
    out.push_back(message(running.client, refused(running.said.seq, why, violations)));
    return out;
  };
  if (!found)
    return refuse(found.error().message, found.error().code == ErrorCode::refuted && running.command &&
                                                 running.knows == last_job_change_
                                             ? violations_of_refused(workspace_, *running.command)
                                             : "[]");
  const bool knows_all = running.knows == last_job_change_;
  if (auto change = knows_all ? rebased(*found, running.said.mode) : std::nullopt)
    return carry_out(running.client, running.said, running.text, std::move(*change), *running.stop);
  constexpr int kMostAttempts = 3;
  if (*running.stop || running.attempts == kMostAttempts)
    return refuse(
        "others changed meanwhile what this command moves, or the places it found; nothing was done");
  // Parts may have other numbers now, so the command is read anew.
  Result<std::optional<Running>> again = read_long(running.client, running.said);
  if (!again) return refuse(again.error().message);
  (*again)->attempts = running.attempts;
  start(std::move(**again));
  return out;
}

Outbound Room::undo(ClientNumber client, const UndoMessage& said) {
  Outbound out;
  Stack& stack = stack_of(clients_[client]);
  std::vector<Revision>& from = said.redo ? stack.undone : stack.done;
  std::vector<Revision>& to = said.redo ? stack.done : stack.undone;
  const auto refuse = [&](const std::string& why) {
    out.push_back(message(client, refused(said.seq, why)));
    return out;
  };
  if (from.empty()) return refuse(said.redo ? "there is nothing to do again" : "there is nothing to undo");
  const Result<StoredChange> stored = store_.change_at(id_, from.back());
  if (!stored) return refuse(stored.error().message);
  StoredChange next;
  next.kind = said.redo ? ChangeKind::redo : ChangeKind::undo;
  next.mode = stored->mode;
  next.target = stored->revision;
  next.text = stored->text;
  Result<layout::Change> wanted = wanted_by(*stored, said.redo);
  if (!wanted) return refuse(wanted.error().message);
  next.change = std::move(*wanted);
  if (Result<void> fine = check_standing(*stored, next.change); !fine) return refuse(fine.error().message);
  if (Result<void> kept = commit(client, std::move(next), out); !kept) return refuse(kept.error().message);
  JsonWriter json = begin_done(said.seq, revision_);
  out.insert(out.begin(), message(client, end_message(json)));
  to.push_back(from.back());
  from.pop_back();
  return out;
}

Result<layout::Change> Room::wanted_by(const StoredChange& command, bool redo) {
  layout::Change wanted = reversed(command.change, document().next_id);
  if (redo) wanted = reversed(wanted, document().next_id);
  LEKALO_TRY(const bool changed, store_.job_changed_since(id_, command.revision));
  if (!changed) return wanted;
  LEKALO_TRY(const layout::Document then,
             store_.state_at(id_, redo ? command.revision - 1 : command.revision));
  Result<layout::Change> now = renumbered(std::move(wanted), then, document());
  if (now) return now;
  return failure(now.error().code, fmt::format("'{}' cannot be {}: {}", brief(command.text),
                                               redo ? "done again" : "undone", now.error().message));
}

std::string Room::preview_text(std::uint64_t seq, const layout::Change& change) {
  std::vector<layout::Violation> violations = workspace_.violations_of(placed_by(change));
  std::string shown = io::violations_json(document(), violations);
  if (!change.features.empty()) {
    layout::carry_out(workspace_, change);
    violations = violations_with(workspace_, change);
    shown = io::violations_json(document(), violations);
    layout::take_back(workspace_, change);
  }
  JsonWriter json = begin_message("preview");
  write_placements(json.field("seq", seq), document(), change);
  write_features(json, document(), change);
  json.key("violations").raw() += shown;
  return end_message(json);
}

Result<std::string> Room::later_change(std::uint64_t id, Revision since) {
  return later_change(fmt::format("placement {}", id),
                      last_touch_.find(id) != last_touch_.end() ? &last_touch_[id] : nullptr, since,
                      [id](const layout::Change& change) {
                        return std::any_of(change.placements.begin(), change.placements.end(),
                                           [id](const PlacementChange& one) { return id_of(one) == id; });
                      });
}

Result<std::string> Room::later_change(const std::string& stock, const layout::Feature& feature,
                                       Revision since) {
  const auto known = last_draw_.find(feature_key(stock, feature));
  return later_change(
      fmt::format("{} '{}'", name_of(feature.kind), feature.id),
      known != last_draw_.end() ? &known->second : nullptr, since, [&](const layout::Change& change) {
        return std::any_of(change.features.begin(), change.features.end(),
                           [&](const layout::FeatureChange& one) {
                             return one.either().kind == feature.kind && one.either().id == feature.id;
                           });
      });
}

Result<std::string> Room::later_change(const std::string& what, const Toucher* known, Revision since,
                                       const std::function<bool(const layout::Change&)>& touches) {
  if (known != nullptr)
    return fmt::format("{} changed {} by '{}' (revision {})", known->who, what, brief(known->text),
                       known->revision);
  // The change is older than this room; the store knows it.
  for (Revision r = revision_; r > since; --r) {
    LEKALO_TRY(const StoredChange change, store_.change_at(id_, r));
    if (touches(change.change))
      return fmt::format("{} changed {} by '{}' (revision {})",
                         change.author.empty() ? "another client" : change.author, what, brief(change.text),
                         r);
  }
  return what + " was changed";
}

namespace {

Result<void> in_the_way(const StoredChange& command, const Result<std::string>& who) {
  if (!who) return tl::unexpected(who.error());
  return failure(ErrorCode::refuted, fmt::format("'{}' stands in the way of a later command: {} since",
                                                 brief(command.text), *who));
}

}  // namespace

Result<void> Room::check_job_standing(const StoredChange& command, const layout::Change& wanted) {
  const layout::JobChange& job = wanted.job;
  const auto refuse = [&](const std::string& what, const auto& touches) {
    const auto known = last_order_.find(what);
    return in_the_way(command, later_change(what, known != last_order_.end() ? &known->second : nullptr,
                                            command.revision, touches));
  };
  const auto refuse_item = [&](const auto& one, auto layout::JobChange::*list) {
    return refuse(named(one), [&, list](const layout::Change& change) {
      const auto& changes = change.job.*list;
      return std::any_of(changes.begin(), changes.end(),
                         [&](const auto& other) { return other.either().id == one.either().id; });
    });
  };
  if (const auto* one = unfit(document().parts, job.parts))
    return refuse_item(*one, &layout::JobChange::parts);
  if (const auto* one = unfit(document().stocks, job.stocks))
    return refuse_item(*one, &layout::JobChange::stocks);
  if (const auto* one = unfit(kits_beside(document(), job), job.kits))
    return refuse_item(*one, &layout::JobChange::kits);
  if (job.rules && !(job.rules->before == document().rules))
    return refuse(kRules, [](const layout::Change& change) { return change.job.rules.has_value(); });
  const std::set<std::string> parts = ids_that_go(job.parts), stocks = ids_that_go(job.stocks);
  std::set<std::uint64_t> taken;
  for (const PlacementChange& one : wanted.placements)
    if (!one.after) taken.insert(one.before->id);
  for (const Placement& placement : document().placements) {
    const bool goes = parts.contains(document().parts[placement.part].id) ||
                      stocks.contains(document().stocks[placement.stock].id);
    if (goes && !taken.contains(placement.id))
      return in_the_way(command, later_change(placement.id, command.revision));
  }
  return {};
}

Result<void> Room::check_standing(const StoredChange& command, const layout::Change& wanted) {
  if (wanted.job.is_nothing()) return check_standing_in(workspace_, command, wanted);
  LEKALO_CHECK(check_job_standing(command, wanted));
  // Placements and features are looked at where parts and stocks have the numbers that the change gives them.
  layout::Document whole = document();
  bring_in(whole, wanted.job);
  layout::Workspace with_job(std::move(whole));
  layout::Change rest = wanted;
  rest.job = {};
  return check_standing_in(with_job, command, rest);
}

Result<void> Room::check_standing_in(layout::Workspace& workspace, const StoredChange& command,
                                     const layout::Change& wanted) {
  const auto refuse = [&](const Result<std::string>& who) { return in_the_way(command, who); };
  for (const PlacementChange& one : wanted.placements) {
    const Placement* const now = workspace.find(id_of(one));
    const bool same = one.before ? now != nullptr && *now == *one.before : now == nullptr;
    if (!same) return refuse(later_change(id_of(one), command.revision));
  }
  for (const layout::FeatureChange& one : wanted.features) {
    const layout::Stock& stock = workspace.document().stocks[one.stock];
    const auto at = find_feature(stock, one.either().kind, one.either().id);
    const bool same = one.before ? at && feature_at(stock, one.either().kind, *at) == *one.before : !at;
    if (!same) return refuse(later_change(stock.id, one.either(), command.revision));
  }
  // A part that was put in the place that became free stands on the command too, where the rules hold.
  if (command.mode == layout::Mode::free) return {};
  const std::vector<Placement> placed = placed_by(wanted);
  const auto is_wanted = [&](std::uint64_t id) {
    return std::any_of(placed.begin(), placed.end(), [&](const Placement& p) { return p.id == id; });
  };
  const auto later = [&](std::uint64_t id) {
    const auto touched = last_touch_.find(id);
    return touched != last_touch_.end() && touched->second.revision > command.revision;
  };
  for (const layout::Violation& v : workspace.violations_of(placed)) {
    const std::uint64_t other = is_wanted(v.a) ? v.b : v.a;
    if (other != 0 && !is_wanted(other) && later(other)) return refuse(later_change(other, command.revision));
    if (feature_id(workspace.document(), v).empty()) continue;
    const auto kind =
        v.kind == layout::ViolationKind::quality ? layout::FeatureKind::zone : layout::FeatureKind::defect;
    const layout::Feature feature = feature_at(workspace.document().stocks[v.stock], kind, v.feature);
    const auto drawn = last_draw_.find(feature_key(workspace.document().stocks[v.stock].id, feature));
    if (drawn != last_draw_.end() && drawn->second.revision > command.revision)
      return refuse(later_change(workspace.document().stocks[v.stock].id, feature, command.revision));
  }
  if (wanted.features.empty()) return {};
  layout::carry_out(workspace, wanted);
  const std::vector<layout::Violation> broken = violations_with(workspace, wanted);
  layout::take_back(workspace, wanted);
  for (const layout::Violation& v : broken)
    if (later(v.a)) return refuse(later_change(v.a, command.revision));
  return {};
}

Result<void> Room::commit(ClientNumber client, StoredChange change, Outbound& out) {
  change.revision = revision_ + 1;
  const auto sender = clients_.find(client);
  if (sender != clients_.end()) change.author = sender->second.author;
  // The store may want the whole document (a snapshot), so the change is carried out first and taken back if
  // it cannot be kept.
  layout::carry_out(workspace_, change.change);
  if (Result<void> kept = store_.append(id_, change, document()); !kept) {
    layout::take_back(workspace_, change.change);
    return failure(kept.error().code, "not stored, and not done: " + kept.error().message);
  }
  revision_ = change.revision;
  const Toucher toucher{revision_, who(client, change), change.text};
  const layout::JobChange& job = change.change.job;
  for (const PlacementChange& one : change.change.placements) last_touch_[id_of(one)] = toucher;
  for (const layout::FeatureChange& one : change.change.features)
    last_draw_[feature_key(stock_id(document(), change.change, one.stock), one.either())] = toucher;
  for (const auto& one : job.parts) last_order_[named(one)] = toucher;
  for (const auto& one : job.stocks) last_order_[named(one)] = toucher;
  for (const auto& one : job.kits) last_order_[named(one)] = toucher;
  if (job.rules) last_order_[kRules] = toucher;
  if (!job.is_nothing()) {
    // Whatever was numbered may be numbered otherwise, so everyone begins anew.
    last_job_change_ = revision_;
    const std::string whole = io::write_layout(document());
    for (const auto& one : clients_)
      out.push_back(message(one.first, layout_text(one.first, whole), Loss::fresh));
    return {};
  }
  JsonWriter json = begin_message("change");
  json.fields(
      {{"revision", revision_}, {"client", client}, {"text", change.text}, {"kind", name_of(change.kind)}});
  write_placements(json, document(), change.change);
  write_features(json, document(), change.change);
  json.field("next_id", document().next_id);
  to_all(end_message(json), Loss::as_newer, out);
  return {};
}

Outbound Room::select(ClientNumber client, const SelectMessage& said) {
  std::vector<std::uint64_t> ids;
  for (const std::uint64_t id : said.ids)
    if (workspace_.find(id) != nullptr) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  Outbound out;
  std::vector<std::uint64_t>& selected = clients_[client].selected;
  if (selected == ids) return out;
  selected = std::move(ids);
  to_all(selections_text(), Loss::as_newer, out);
  return out;
}

Result<Outbound> Room::restore(Revision revision) {
  Outbound out;
  LEKALO_TRY(const layout::Document state, store_.state_at(id_, revision));
  StoredChange change;
  change.kind = ChangeKind::restore;
  change.mode = layout::Mode::free;
  change.target = revision;
  change.text = fmt::format("restore {}", revision);
  change.change = layout::difference(document(), state);
  change.change.next_id_after = document().next_id;
  if (change.change.is_nothing()) return out;
  LEKALO_CHECK(commit(0, std::move(change), out));
  return out;
}

Result<Outbound> Room::add(const std::string& author, layout::Additions additions,
                           std::vector<std::string>& added) {
  Outbound out;
  const std::size_t parts = additions.parts.size(), stocks = additions.stocks.size();
  if (document().parts.size() + parts > layout::kMostItems ||
      document().stocks.size() + stocks > layout::kMostItems)
    return failure(
        ErrorCode::bad_input,
        fmt::format("with these the layout would have more than {} parts or stocks", layout::kMostItems));
  StoredChange change;
  change.author = author;
  change.change.next_id_before = change.change.next_id_after = document().next_id;
  change.change.job = layout::added(document(), std::move(additions));
  for (const auto& one : change.change.job.parts) added.push_back(one.after->id);
  for (const auto& one : change.change.job.stocks) added.push_back(one.after->id);
  change.text = "add";
  for (const std::string& id : added) change.text += " " + layout::quoted_name(id);
  LEKALO_CHECK(commit(0, std::move(change), out));
  // Who has not been here yet reads what may be undone from the store.
  if (const auto stack = stacks_.find(author); stack != stacks_.end()) {
    stack->second.done.push_back(revision_);
    stack->second.undone.clear();
  }
  return out;
}

Result<Outbound> Room::rename(const std::string& name) {
  Outbound out;
  LEKALO_CHECK(store_.rename(id_, name));
  name_ = name;
  JsonWriter json = begin_message("name");
  to_all(end_message(json.field("name", name)), Loss::as_newer, out);
  return out;
}

Result<Outbound> Room::set_photo(const Photo& photo, const std::string& image) {
  const auto& stocks = document().stocks;
  if (std::none_of(stocks.begin(), stocks.end(), [&](const auto& one) { return one.id == photo.stock; }))
    return failure(ErrorCode::usage, fmt::format("the layout has no stock '{}'", photo.stock));
  LEKALO_CHECK(store_.set_photo(id_, photo, image));
  return photo_changed(photo.stock, true);
}

Result<Outbound> Room::set_photo_scale(const std::string& stock, const PhotoScale& scale) {
  LEKALO_CHECK(store_.set_photo_scale(id_, stock, scale));
  return photo_changed(stock, false);
}

Result<Outbound> Room::remove_photo(const std::string& stock) {
  LEKALO_CHECK(store_.remove_photo(id_, stock));
  return photo_changed(stock, true);
}

Outbound Room::photo_changed(const std::string& stock, bool image) const {
  Outbound out;
  JsonWriter json = begin_message("photos");
  to_all(end_message(json.fields({{"stock", stock}, {"image", image}})), Loss::as_newer, out);
  return out;
}

Result<Outbound> Room::remove() {
  Outbound out;
  LEKALO_CHECK(store_.remove(id_));
  JsonWriter json = begin_message("bye");
  to_all(end_message(json.field("message", "the layout was deleted")), Loss::never, out);
  clients_.clear();
  removed_ = true;
  return out;
}

Room::Stack& Room::stack_of(Client& client) {
  return client.author.empty() ? client.own : stacks_[client.author];
}

std::string Room::who(ClientNumber client, const StoredChange& change) const {
  const auto at = clients_.find(client);
  if (at == clients_.end()) return change.author.empty() ? "a restore" : change.author;
  return at->second.author.empty() ? fmt::format("client {}", client)
                                   : fmt::format("client {} ({})", client, at->second.author);
}

void Room::to_all(const std::string& text, Loss loss, Outbound& out) const {
  const auto shared = std::make_shared<const std::string>(text);
  for (const auto& [number, client] : clients_) out.push_back({number, shared, loss});
}

std::string Room::layout_text(ClientNumber client, const std::string& document) const {
  JsonWriter json = begin_message("layout");
  json.fields({{"client", client}, {"revision", revision_}, {"name", name_}});
  json.key("document").raw() += document;
  return end_message(json);
}

std::string Room::selections_text() const {
  JsonWriter json = begin_message("selections");
  json.key("clients").begin_list();
  for (const auto& [number, client] : clients_)
    if (!client.selected.empty())
      json.begin_object().field("client", number).key("ids").list(client.selected).end();
  json.end();
  return end_message(json);
}

}  // namespace lekalo::server
