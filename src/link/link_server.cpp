#include "link/link_server.h"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "link/messages.h"

namespace palpation::link {
namespace {

constexpr const char* kAnswers = "palpate";  // the device that answers for all

std::string seconds(double value) {
  std::string digits = std::to_string(value);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits + " s";
}

/// The kind that a request asks for: GET_TRANS and GET_TRANSFORM are the same.
std::string kind_asked(const std::string& type) {
  const std::string kind = type.substr(4);
  return kind == "TRANS" ? "TRANSFORM" : kind;
}

}  // namespace

LinkServer::LinkServer(const ServerOptions& options, Listener listener)
    : options_(options),
      tell_(std::move(listener)),
      listener_(listen_at(options.host, options.port)) {}

void LinkServer::show(Shown message) {
  const auto known = std::ranges::find(latest_, message.device, &Latest::device);
  if (known != latest_.end() && known->kind == message.kind &&
      body_of(*known->bytes) == body_of(message.bytes))
    return;
  const auto bytes = std::make_shared<const std::string>(std::move(message.bytes));
  for (Client& client : clients_) client.outbox.put(message.device, bytes);
  if (known != latest_.end())
    *known = {message.device, message.kind, bytes};
  else
    latest_.push_back({message.device, message.kind, bytes});
}

void LinkServer::serve(std::chrono::milliseconds time) {
  const Clock::time_point end_of_round = Clock::now() + time;
  do {
    wait(std::max(
        std::chrono::milliseconds(0),
        std::chrono::duration_cast<std::chrono::milliseconds>(end_of_round - Clock::now())));
    let_in();
    for (Client& client : clients_) receive(client);
    for (Client& client : clients_) send(client);
    clients_.remove_if([](const Client& client) { return client.is_gone; });
  } while (Clock::now() < end_of_round);
}

void LinkServer::wait(std::chrono::milliseconds time) const {
  std::vector<pollfd> watched{{listener_.descriptor(), POLLIN, 0}};
  for (const Client& client : clients_)
    watched.push_back({client.socket.descriptor(),
                       static_cast<short>(POLLIN | (client.outbox.is_empty() ? 0 : POLLOUT)), 0});
  ::poll(watched.data(), watched.size(), static_cast<int>(time.count()));
}

void LinkServer::let_in() {
  for (;;) {
    Socket socket = accept_at(listener_);
    if (socket.descriptor() < 0) return;
    const std::string name = peer_of(socket);
    if (clients_.size() >= options_.most_clients) {
      tell_(Said::Dropped, name + " is turned away: there are " +
                               std::to_string(options_.most_clients) + " clients already");
      continue;
    }
    Client& client = clients_.emplace_back(
        Client{.socket = std::move(socket), .name = name, .took = Clock::now()});
    for (const Latest& one : latest_) client.outbox.put(one.device, one.bytes);
    tell_(Said::Connected, name + " is connected");
  }
}

/// A chunk at most, so that nobody who talks without end keeps the others waiting.
void LinkServer::receive(Client& client) {
  std::string bytes;
  const Transfer transfer = receive_some(client.socket, bytes);
  if (transfer == Transfer::Gone) return end(client, Said::Closed, "has closed the connection");
  if (client.incoming.is_garbage()) return;
  for (const Heard& heard : client.incoming.take(bytes)) answer(client, heard);
  if (client.incoming.is_garbage())
    tell_(Said::Odd, client.name +
                         " says what is no OpenIGTLink: that and all that follows is not "
                         "listened to; it is sent what changes as before");
}

void LinkServer::answer(Client& client, const Heard& heard) {
  if (!heard.type.starts_with("GET_")) return;  // all else is none of ours
  const std::string kind = kind_asked(heard.type);
  if (kind == "CAPABIL") {
    std::vector<std::string> kinds;
    for (const Latest& one : latest_)
      if (std::ranges::find(kinds, one.kind) == kinds.end()) kinds.push_back(one.kind);
    const std::string bytes = capability_message(kAnswers, kinds);
    return client.outbox.put("CAPABILITY", std::make_shared<const std::string>(bytes));
  }
  bool is_known = false;
  for (const Latest& one : latest_) {
    if (one.kind != kind || (!heard.device.empty() && one.device != heard.device)) continue;
    client.outbox.put(one.device, one.bytes);
    is_known = true;
  }
  if (is_known) return;
  const std::string bytes =
      status_message(kAnswers, Status::NotFound,
                     "there is no " + kind + (heard.device.empty() ? "" : " " + heard.device));
  client.outbox.put("NotFound", std::make_shared<const std::string>(bytes));
}

void LinkServer::send(Client& client) {
  const Clock::time_point now = Clock::now();
  while (!client.is_gone && !client.outbox.is_empty()) {
    std::size_t sent = 0;
    const Transfer transfer = send_some(client.socket, client.outbox.next(), sent);
    if (transfer == Transfer::Gone) return end(client, Said::Closed, "has closed the connection");
    if (transfer == Transfer::WouldWait) {
      if (std::chrono::duration<double>(now - client.took).count() > options_.patience_s)
        end(client, Said::Dropped,
            "is dropped: it has taken nothing for " + seconds(options_.patience_s));
      return;
    }
    client.outbox.sent(sent);
    client.took = now;
  }
  client.took = now;
}

void LinkServer::end(Client& client, Said said, const std::string& words) {
  if (client.is_gone) return;
  client.is_gone = true;
  tell_(said, client.name + " " + words);
}

}  // namespace palpation::link
