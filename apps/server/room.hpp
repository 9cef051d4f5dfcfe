#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "lekalo/layout/workspace.hpp"
#include "messages.hpp"
#include "store.hpp"

namespace lekalo::server {

/// Number of a connection, unique while the server runs.
using ClientNumber = std::uint64_t;

/// How a message may be left out when a client reads slower than others write.
enum class Loss : std::uint8_t {
  never,     ///< an answer
  as_newer,  ///< the state of a moment; a fresh `layout` takes the place of all of them
  fresh      ///< that `layout`
};

struct Outgoing {
  ClientNumber to = 0;
  std::shared_ptr<const std::string> text;  ///< shared by all who get it
  Loss loss = Loss::never;
};
using Outbound = std::vector<Outgoing>;

/// One layout that is open: its state, its clients, and what each of them is to hear. Knows no network; one
/// call at a time. Nothing is said to be done before the store has it.
class Room {
 public:
  Room(Store& store, LayoutId id, StoredLayout layout);

  /// A client comes in and gets the layout. `author` names whoever sits there across connections and
  /// restarts, so that undo goes on where it was; empty: nobody, what it does can be undone until it leaves.
  [[nodiscard]] Result<Outbound> join(ClientNumber client, const std::string& author);
  [[nodiscard]] Outbound leave(ClientNumber client);
  [[nodiscard]] Outbound handle(ClientNumber client, const ClientMessage& message);
  /// The layout as it is now, to one who missed some of it.
  [[nodiscard]] Outbound resend(ClientNumber client) const;

  /// Makes the state of that revision the newest one. A state that is the newest already gives no new
  /// revision.
  [[nodiscard]] Result<Outbound> restore(Revision revision);
  [[nodiscard]] Result<Outbound> rename(const std::string& name);
  /// From the store too. Everyone in the room is told.
  [[nodiscard]] Result<Outbound> remove();

  [[nodiscard]] Revision revision() const noexcept { return revision_; }
  [[nodiscard]] bool empty() const noexcept { return clients_.empty(); }
  [[nodiscard]] const layout::Document& document() const noexcept { return workspace_.document(); }

 private:
  /// Revisions of commands: what undo takes back next, and what redo does again.
  struct Stack {
    std::vector<Revision> done, undone;
  };
  struct Client {
    std::string author;
    Stack own;  ///< of one without an author
    std::vector<std::uint64_t> selected;
  };
  struct Toucher {
    Revision revision = 0;
    std::string who;
    std::string text;
  };

  [[nodiscard]] Outbound command(ClientNumber client, const CommandMessage& message);
  [[nodiscard]] Outbound undo(ClientNumber client, const UndoMessage& message);
  [[nodiscard]] Outbound select(ClientNumber client, const SelectMessage& message);
  [[nodiscard]] Stack& stack_of(Client& client);
  [[nodiscard]] std::string who(ClientNumber client) const;
  [[nodiscard]] std::string preview_text(std::uint64_t seq, const layout::Change& change);
  /// Who changed the placement or the feature last, as a sentence's end.
  [[nodiscard]] Result<std::string> later_change(std::uint64_t id, Revision since);
  [[nodiscard]] Result<std::string> later_change(std::uint32_t stock, const layout::Feature& feature,
                                                 Revision since);
  [[nodiscard]] Result<std::string> later_change(const std::string& what, const Toucher* known,
                                                 Revision since,
                                                 const std::function<bool(const layout::Change&)>& touches);
  /// Why a change cannot be put in place of the state that is there, or nothing.
  [[nodiscard]] Result<void> check_standing(const StoredChange& command, const layout::Change& wanted);
  /// Store first, then the state, then everyone hears of it.
  [[nodiscard]] Result<void> commit(ClientNumber client, StoredChange change, Outbound& out);
  void to_all(const std::string& text, Loss loss, Outbound& out) const;
  [[nodiscard]] std::string layout_text(ClientNumber client) const;
  [[nodiscard]] std::string selections_text() const;

  Store& store_;
  LayoutId id_;
  std::string name_;
  Revision revision_;
  bool removed_ = false;
  layout::Workspace workspace_;
  std::map<ClientNumber, Client> clients_;
  std::map<std::string, Stack> stacks_;                    ///< by author
  std::unordered_map<std::uint64_t, Toucher> last_touch_;  ///< by placement, since the room is open
  std::unordered_map<std::string, Toucher> last_draw_;     ///< by feature, likewise
};

}  // namespace lekalo::server
