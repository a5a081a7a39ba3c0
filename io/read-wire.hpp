// Messages between a program that needs pictures and the reading process, over a stream socket.
//
// Numbers and pixels are sent in their memory representation, since both ends are of one build and on one machine.
// Each end checks sizes before it allocates memory.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_WIRE_HPP
#define CELDEPTH_READ_WIRE_HPP

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

// The connection is closed, or the other end violates the protocol.
struct WireFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// The first number that a worker sends.  It has to change with the messages, because a module may find a celdepth-read
// of another version.
constexpr uint32_t wire_version = 0xCE1D0002;

// The descriptor that is celdepth-read's end of the control socket.
constexpr int control_descriptor = 3;

enum class Request : uint8_t { open, colours, values };
enum class Answer : uint8_t { good, failed };

// Most bytes of a text (path, name, message) and of an ICC profile (chosen).
constexpr size_t longest_text = size_t (1) << 16;
constexpr size_t longest_profile = size_t (1) << 26;

// One end of the socket, which it owns.
class Wire
{
public:
  explicit Wire (int descriptor) : end (descriptor) {}
  ~Wire ();
  Wire (const Wire &) = delete;
  Wire &operator= (const Wire &) = delete;

  // Send or receive all bytes, or throw a WireFailure.
  void send (const void *bytes, size_t size) const;
  void receive (void *bytes, size_t size) const;

  // Send or receive a number, or a struct of numbers.
  template <typename Value>
  void
  send (Value value) const
  {
    static_assert (std::is_trivial<Value>::value && !std::is_pointer<Value>::value);
    send (&value, sizeof value);
  }

  template <typename Value>
  Value
  receive () const
  {
    Value value;

    static_assert (std::is_trivial<Value>::value && !std::is_pointer<Value>::value);
    receive (&value, sizeof value);
    return value;
  }

  void        send_text (const std::string &text, size_t longest = longest_text) const; // cut at `longest`
  std::string receive_text (size_t longest = longest_text) const;

private:
  int end;
};

// Sends a descriptor; false if the connection is closed.
bool send_descriptor (int socket, int descriptor);

// Receives a descriptor, close-on-exec; -1 if the connection is closed, or after `timeout` milliseconds (-1: no limit).
int receive_descriptor (int socket, int timeout);

// Answers requests on the control socket, each file in a process of its own, until the other end closes it or makes no
// request for `timeout` milliseconds (-1: no limit).  The process must have a single thread.
void serve_readers (int control, int timeout);

#endif
