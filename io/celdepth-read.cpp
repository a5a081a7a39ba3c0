// The program celdepth-read: decodes pictures for a program that must not crash.  The GEGL operations start it
// (read.cpp), with a socket as descriptor 3.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-wire.hpp"

#include <cstdio>

#include <sys/socket.h>
#include <unistd.h>

constexpr int timeout = 30000; // milliseconds without a request until it exits (chosen: starting again takes 0.2 s)

int
main ()
{
  int       type;
  socklen_t size = sizeof type;

  if (getsockopt (control_descriptor, SOL_SOCKET, SO_TYPE, &type, &size))
    {
      std::fputs ("The operations of celdepth start celdepth-read; it cannot be used by itself.\n", stderr);
      return 2;
    }
  close_range (control_descriptor + 1, ~0U, 0);
  // The program that started this one waits for it to exit; its child serves, and init reaps it.
  if (fork () == 0)
    serve_readers (control_descriptor, timeout);
  _exit (0);
}
