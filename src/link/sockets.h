/// TCP, by the machine's own calls, none of which waits.
#pragma once

#include <string>
#include <string_view>

namespace palpation::link {

/// Closed with its owner.
class Socket {
 public:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  ~Socket();
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// "127.0.0.1:18944", "[::1]:18944": of this end, or of the other one.
std::string address_of(const Socket& socket);
std::string peer_of(const Socket& socket);

/// Listens there; port 0: any that is free. Throws WriteError, with what to do where the port is
/// another program's.
Socket listen_at(const std::string& host, int port);

/// Who waits to be let in, if anybody does: descriptor -1 otherwise. Throws nothing: a machine that
/// has no more descriptors is asked again later.
Socket accept_at(const Socket& listener);

enum class Transfer { Done, WouldWait, Gone };

/// Sends what the machine takes at once; `sent`: how many bytes that was.
Transfer send_some(const Socket& socket, std::string_view bytes, std::size_t& sent);
/// Receives what is there, into `bytes`.
Transfer receive_some(const Socket& socket, std::string& bytes);

}  // namespace palpation::link
