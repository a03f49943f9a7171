/// Shows the latest of each device to every client, and lets none wait for another.
///
/// Laws: (1) nothing here waits for a client: each has an outbox that is bounded, and what it does
/// not take in time ends it alone; (2) who comes gets the latest of every device, in the order in
/// which they were first shown, and then what changes; (3) a message whose body did not change is
/// not sent again; (4) whatever a client says, the others notice nothing.
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "link/incoming.h"
#include "link/outbox.h"
#include "link/sockets.h"

namespace palpation::link {

/// A message that is ready to go: of which device, and of which kind, such as "POLYDATA".
struct Shown {
  std::string device, kind;
  std::string bytes;
};

enum class Said { Connected, Closed, Dropped, Odd };

/// What happened to a client, in words.
using Listener = std::function<void(Said said, const std::string& words)>;

struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 18944;          ///< 0: any that is free
  double patience_s = 10.0;  ///< for a client that takes nothing
  std::size_t most_clients = 32;
};

class LinkServer {
 public:
  /// Listens. Throws WriteError where it cannot.
  LinkServer(const ServerOptions& options, Listener listener);

  void show(Shown message);
  /// Lets in, receives, answers, sends and drops, for so long.
  void serve(std::chrono::milliseconds time);
  std::string address() const { return address_of(listener_); }
  std::size_t clients() const { return clients_.size(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Latest {
    std::string device, kind;
    SharedBytes bytes;
  };
  struct Client {
    Socket socket;
    std::string name;
    Incoming incoming{};
    Outbox outbox{};
    Clock::time_point took;  ///< when it last took something, or had nothing to take
    bool is_gone = false;
  };

  void wait(std::chrono::milliseconds time) const;
  void let_in();
  void receive(Client& client);
  void answer(Client& client, const Heard& heard);
  void send(Client& client);
  void end(Client& client, Said said, const std::string& words);

  ServerOptions options_;
  Listener tell_;
  Socket listener_;
  std::vector<Latest> latest_;
  std::list<Client> clients_;
};

}  // namespace palpation::link
