"""The master of ROS 1, asked whether it is there: who does not answer soon is not."""

import http.client
import os
import xmlrpc.client

ANSWERS_WITHIN_S = 2.0


class WithDeadline(xmlrpc.client.Transport):
    def make_connection(self, host):
        return http.client.HTTPConnection(self.get_host_info(host)[0], timeout=ANSWERS_WITHIN_S)


class Master:
    def __init__(self):
        self.uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        self.proxy = xmlrpc.client.ServerProxy(self.uri, transport=WithDeadline())

    def ping(self):
        """Throws OSError where it does not answer."""
        try:
            self.proxy.getPid("/palpate_arm")
        except (OSError, xmlrpc.client.Error, http.client.HTTPException) as error:
            raise OSError(f"the ROS master does not answer at {self.uri}: {error}") from error
