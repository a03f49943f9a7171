#include "link/sockets.h"

#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "palpation/base/error.h"

namespace palpation::link {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
/// What the machine keeps for a client that does not read: the rest waits in its outbox, where a
/// newer message takes the place of an older one.
constexpr int kSendBuffer_bytes = 1 << 18;
constexpr int kMostWaiting = 16;

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

std::string words_of(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannot_listen(const std::string& place, const std::string& why) {
  throw WriteError("link: cannot listen at " + place + ": " + why);
}

Addresses addresses_of(const std::string& host, int port, const std::string& place) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int fault = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  if (fault != 0)
    cannot_listen(place, std::string(::gai_strerror(fault)) +
                             ": --host is an address of this machine, such as 127.0.0.1 for "
                             "programs on it, or 0.0.0.0 for all that reach it");
  return {found, &::freeaddrinfo};
}

bool does_not_wait(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  return flags >= 0 && ::fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) == 0;
}

void set(int descriptor, int option, int value) {
  ::setsockopt(descriptor, SOL_SOCKET, option, &value, sizeof value);
}

std::string told(const Socket& socket, decltype(&::getsockname) whose) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  auto* const general = reinterpret_cast<sockaddr*>(&address);
  if (whose(socket.descriptor(), general, &length) != 0) return "?";
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (::getnameinfo(general, length, host.data(), host.size(), port.data(), port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return "?";
  const std::string name = host.data();
  return (name.find(':') == std::string::npos ? name : "[" + name + "]") + ":" + port.data();
}

}  // namespace

Socket::~Socket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Socket::Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

std::string address_of(const Socket& socket) { return told(socket, &::getsockname); }
std::string peer_of(const Socket& socket) { return told(socket, &::getpeername); }

Socket listen_at(const std::string& host, int port) {
  const std::string place = host + ":" + std::to_string(port);
  const Addresses found = addresses_of(host, port, place);
  Socket listener(::socket(found->ai_family, found->ai_socktype | SOCK_CLOEXEC, 0));
  if (listener.descriptor() < 0) cannot_listen(place, words_of(errno));
  set(listener.descriptor(), SO_REUSEADDR, 1);  // at once after an end
  if (::bind(listener.descriptor(), found->ai_addr, found->ai_addrlen) != 0 ||
      ::listen(listener.descriptor(), kMostWaiting) != 0) {
    const int error = errno;
    cannot_listen(
        place,
        words_of(error) + (error == EADDRINUSE ? ": another program listens there, such as another "
                                                 "palpate link: end it, or give another --port"
                                               : ""));
  }
  if (!does_not_wait(listener.descriptor())) cannot_listen(place, words_of(errno));
  return listener;
}

Socket accept_at(const Socket& listener) {
  Socket client(::accept(listener.descriptor(), nullptr, nullptr));
  if (client.descriptor() < 0) return client;
  ::fcntl(client.descriptor(), F_SETFD, FD_CLOEXEC);
  set(client.descriptor(), SO_KEEPALIVE, 1);
  set(client.descriptor(), SO_SNDBUF, kSendBuffer_bytes);
  return does_not_wait(client.descriptor()) ? std::move(client) : Socket(-1);
}

Transfer send_some(const Socket& socket, std::string_view bytes, std::size_t& sent) {
  const ssize_t count = ::send(socket.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  sent = count > 0 ? static_cast<std::size_t>(count) : 0;
  if (count >= 0) return Transfer::Done;
  const bool waits = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ENOBUFS;
  return waits ? Transfer::WouldWait : Transfer::Gone;
}

Transfer receive_some(const Socket& socket, std::string& bytes) {
  bytes.resize(kChunk);
  const ssize_t count = ::recv(socket.descriptor(), bytes.data(), bytes.size(), 0);
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  if (count > 0) return Transfer::Done;
  const bool waits = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return waits ? Transfer::WouldWait : Transfer::Gone;
}

}  // namespace palpation::link
