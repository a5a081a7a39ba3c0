// celdepth-read: reads pictures for a program that must not crash with them.  Started by the operations (read.cpp), not
// by people; descriptor 3 is its socket.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-wire.hpp"

#include <cstdio>

#include <sys/socket.h>
#include <unistd.h>

constexpr int patience = 30000; // milliseconds; chosen: a new one takes 0.2 s to start

int
main ()
{
  int       type;
  socklen_t size = sizeof type;

  if (getsockopt (control_descriptor, SOL_SOCKET, SO_TYPE, &type, &size))
    {
      std::fputs ("celdepth-read is started by the operations of celdepth, not by hand.\n", stderr);
      return 2;
    }
  close_range (control_descriptor + 1, ~0U, 0);
  // The starter waits for the first process, the second serves: nobody has to look after it when it ends.
  if (fork () == 0)
    serve_readers (control_descriptor, patience);
  _exit (0);
}
