#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "job.hpp"
#include "lekalo/layout/workspace.hpp"
#include "messages.hpp"
#include "store/store.hpp"

namespace lekalo::server {

/// The number of a connection, unique while the server runs.
using ClientNumber = std::uint64_t;

/// Says whether a message may be left out when a client reads slower than others write.
enum class Loss : std::uint8_t {
  never,     ///< an answer must arrive
  as_newer,  ///< the state of a moment; a fresh `layout` replaces all of these
  fresh      ///< a fresh `layout` itself
};

struct Outgoing {
  ClientNumber to = 0;
  /// The text is shared by all clients who get it.
  std::shared_ptr<const std::string> text;
  Loss loss = Loss::never;
};
using Outbound = std::vector<Outgoing>;

/// One layout that is open: its state, its clients, and what each of them is to be told. A room knows nothing
/// of the network, and takes one call at a time. It tells nobody that something is done before the store has
/// it.
class Room {
 public:
  Room(Store& store, LayoutId id, StoredLayout layout);

  /// Lets a client in and gives it the layout. `author` names whoever sits there across connections and
  /// restarts, so that undo goes on where it was. When it is empty, what the client does can be undone until
  /// it leaves.
  [[nodiscard]] Result<Outbound> join(ClientNumber client, const std::string& author);
  [[nodiscard]] Outbound leave(ClientNumber client);
  /// \param gone  set when nobody waits for the answer any more. What is still only planned is dropped then.
  [[nodiscard]] Outbound handle(ClientNumber client, const ClientMessage& message,
                                const std::atomic<bool>& gone = kNever);
  /// Says whether a long command of this client is under way. Its further commands then have to wait.
  [[nodiscard]] bool is_busy(ClientNumber client) const;
  /// Returns the jobs that are to be run now, each of them once. The room is told of them by job_progress,
  /// job_improved and job_ended.
  [[nodiscard]] std::vector<JobStart> take_jobs();
  /// Returns the client that started the job; 0 for a job that has ended.
  [[nodiscard]] ClientNumber client_of(JobNumber job) const;
  [[nodiscard]] Outbound job_progress(JobNumber job, double fraction,
                                      std::optional<double> seconds_left) const;
  [[nodiscard]] Outbound job_improved(JobNumber job, const layout::Change& change) const;
  /// Carries out what a job found, or lets the job begin again where others changed what it builds on.
  [[nodiscard]] Outbound job_ended(JobNumber job, const Result<layout::Change>& found);

  /// Returns the layout as it is now, for a client that missed some of it.
  [[nodiscard]] Outbound resend(ClientNumber client) const;

  /// Makes the state of that revision the newest one. A state that already is the newest gives no new
  /// revision.
  [[nodiscard]] Result<Outbound> restore(Revision revision);
  /// Brings parts and stocks in, as one change of this author, who may undo it.
  /// \param added  is set to the ids that they have
  [[nodiscard]] Result<Outbound> add(const std::string& author, layout::Additions additions,
                                     std::vector<std::string>& added);
  [[nodiscard]] Result<Outbound> rename(const std::string& name);
  /// These three keep a photograph of a stock, change its scale, or take it away, and tell everyone.
  [[nodiscard]] Result<Outbound> set_photo(const Photo& photo, const std::string& image);
  [[nodiscard]] Result<Outbound> set_photo_scale(const std::string& stock, const PhotoScale& scale);
  [[nodiscard]] Result<Outbound> remove_photo(const std::string& stock);
  /// Deletes the layout, from the store too, and tells everyone in the room.
  [[nodiscard]] Result<Outbound> remove();

  [[nodiscard]] Revision revision() const noexcept { return revision_; }
  [[nodiscard]] bool empty() const noexcept { return clients_.empty(); }
  [[nodiscard]] std::vector<ClientNumber> clients() const;
  [[nodiscard]] const layout::Document& document() const noexcept { return workspace_.document(); }

 private:
  /// Revisions of commands: what undo takes back next, and what redo does again.
  struct Stack {
    std::vector<Revision> done, undone;
  };
  struct Client {
    std::string author;
    /// The stack of a client that has no author.
    Stack own;
    std::vector<std::uint64_t> selected;
  };
  /// A long command that is under way.
  struct Running {
    ClientNumber client = 0;
    CommandMessage said;
    /// The command as the history names it.
    std::string text;
    /// The layout's command; none for a request that is no command of a layout (nest_job.hpp).
    std::optional<layout::Command> command;
    Job job;
    /// The last change of the job that it knows.
    Revision knows = 0;
    std::shared_ptr<std::atomic<bool>> stop = nullptr;
    int attempts = 0;
  };
  static constexpr std::atomic<bool> kNever{false};
  struct Toucher {
    Revision revision = 0;
    std::string who;
    std::string text;
  };

  [[nodiscard]] Outbound command(ClientNumber client, const CommandMessage& message,
                                 const std::atomic<bool>& gone);
  /// Answers a command whose change is planned: the change is shown or carried out.
  [[nodiscard]] Outbound carry_out(ClientNumber client, const CommandMessage& said, const std::string& text,
                                   layout::Change change, bool stopped = false);
  /// Reads a command that takes long; nothing where it takes a moment.
  [[nodiscard]] Result<std::optional<Running>> read_long(ClientNumber client,
                                                         const CommandMessage& said) const;
  void start(Running running);
  void stop(ClientNumber client, const StopMessage& message);
  /// Returns a change that was planned on an earlier state as a change of this state; none where that is not
  /// possible any more.
  [[nodiscard]] std::optional<layout::Change> rebased(const layout::Change& change, layout::Mode mode) const;
  [[nodiscard]] Outbound undo(ClientNumber client, const UndoMessage& message);
  [[nodiscard]] Outbound select(ClientNumber client, const SelectMessage& message);
  [[nodiscard]] Stack& stack_of(Client& client);
  [[nodiscard]] std::string who(ClientNumber client, const StoredChange& change) const;
  [[nodiscard]] std::string preview_text(std::uint64_t seq, const layout::Change& change);
  /// Returns the end of a sentence that says who changed the placement or the feature last.
  [[nodiscard]] Result<std::string> later_change(std::uint64_t id, Revision since);
  [[nodiscard]] Result<std::string> later_change(const std::string& stock, const layout::Feature& feature,
                                                 Revision since);
  [[nodiscard]] Result<std::string> later_change(const std::string& what, const Toucher* known,
                                                 Revision since,
                                                 const std::function<bool(const layout::Change&)>& touches);
  /// Returns what undo or redo puts in place of the present state, with the numbers that parts have now.
  [[nodiscard]] Result<layout::Change> wanted_by(const StoredChange& command, bool redo);
  [[nodiscard]] Result<void> check_job_standing(const StoredChange& command, const layout::Change& wanted);
  /// Says why a change cannot be put in place of the present state; success where it can.
  [[nodiscard]] Result<void> check_standing(const StoredChange& command, const layout::Change& wanted);
  [[nodiscard]] Result<void> check_standing_in(layout::Workspace& workspace, const StoredChange& command,
                                               const layout::Change& wanted);
  /// Puts a change into the store first, then into the state, and then tells everyone.
  [[nodiscard]] Result<void> commit(ClientNumber client, StoredChange change, Outbound& out);
  [[nodiscard]] Outbound photo_changed(const std::string& stock, bool image) const;
  void to_all(const std::string& text, Loss loss, Outbound& out) const;
  /// \param document  as a layout file
  [[nodiscard]] std::string layout_text(ClientNumber client, const std::string& document) const;
  [[nodiscard]] std::string selections_text() const;

  Store& store_;
  LayoutId id_;
  std::string name_;
  Revision revision_;
  bool removed_ = false;
  layout::Workspace workspace_;
  std::map<ClientNumber, Client> clients_;
  std::map<JobNumber, Running> running_;
  std::vector<JobStart> starting_;
  JobNumber last_job_ = 0;
  std::map<std::string, Stack> stacks_;                    ///< by author
  std::unordered_map<std::uint64_t, Toucher> last_touch_;  ///< by placement, since the room was opened
  std::unordered_map<std::string, Toucher> last_draw_;     ///< by feature, since the room was opened
  std::unordered_map<std::string, Toucher> last_order_;    ///< by part or stock, since the room was opened
  Revision last_job_change_ = 0;                           ///< since the room was opened; 0: none
};

}  // namespace lekalo::server
