// Sends and receives bytes and file descriptors over a socket.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-wire.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

// ------------------------------------------------------------------ bytes

Wire::~Wire ()
{
  close (end);
}

void
Wire::send (const void *bytes, size_t size) const
{
  const char *next = static_cast<const char *> (bytes);

  while (size > 0)
    {
      ssize_t sent = ::send (end, next, size, MSG_NOSIGNAL);

      if (sent < 0 && errno == EINTR)
        continue;
      if (sent <= 0)
        throw WireFailure ("the connection is closed");
      next += sent;
      size -= size_t (sent);
    }
}

void
Wire::receive (void *bytes, size_t size) const
{
  char *next = static_cast<char *> (bytes);

  while (size > 0)
    {
      ssize_t received = recv (end, next, size, 0);

      if (received < 0 && errno == EINTR)
        continue;
      if (received <= 0)
        throw WireFailure ("the connection is closed");
      next += received;
      size -= size_t (received);
    }
}

void
Wire::send_text (const std::string &text, size_t longest) const
{
  size_t size = std::min (text.size (), longest);

  send (uint32_t (size));
  send (text.data (), size);
}

std::string
Wire::receive_text (size_t longest) const
{
  size_t      size = receive<uint32_t> ();
  std::string text;

  if (size > longest)
    throw WireFailure ("a text is too long");
  text.resize (size);
  receive (text.data (), size);
  return text;
}

// ------------------------------------------------------------------ descriptors

// A message of one byte that carries a descriptor.
struct DescriptorMessage
{
  char   byte = 0;
  iovec  content = { &byte, 1 };
  alignas (cmsghdr) char control[CMSG_SPACE (sizeof (int))] = {};
  msghdr message = {};

  DescriptorMessage ()
  {
    message.msg_iov = &content;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
  }
};

bool
send_descriptor (int socket, int descriptor)
{
  DescriptorMessage carrier;
  cmsghdr          *header = CMSG_FIRSTHDR (&carrier.message);
  ssize_t           sent;

  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN (sizeof descriptor);
  std::memcpy (CMSG_DATA (header), &descriptor, sizeof descriptor);
  do
    sent = sendmsg (socket, &carrier.message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == 1;
}

int
receive_descriptor (int socket, int timeout)
{
  DescriptorMessage carrier;
  pollfd            ready = { socket, POLLIN, 0 };
  ssize_t           received;
  const cmsghdr    *header;
  int               descriptor;

  do
    received = poll (&ready, 1, timeout);
  while (received < 0 && errno == EINTR);
  if (received <= 0)
    return -1;
  do
    received = recvmsg (socket, &carrier.message, MSG_CMSG_CLOEXEC);
  while (received < 0 && errno == EINTR);
  header = received == 1 ? CMSG_FIRSTHDR (&carrier.message) : nullptr;
  if (!header || header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS)
    return -1;
  std::memcpy (&descriptor, CMSG_DATA (header), sizeof descriptor);
  return descriptor;
}
