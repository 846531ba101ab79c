"""What is put in the place of bbsd's own is met by all that use it, wherever modules move."""

import subprocess
import sys

PUT = """
import bbsd.runs.workers.side_by_side as user
from bbsd.engines import local
from bbsd.runs.storage import records
from bbsd.runs.workers import remote
from fuzzing.faults.commands import put_in_place

put_in_place(local, "processes_engine", "forked")
put_in_place(records, "INTERVAL", 7.0)
print(local.processes_engine, user.processes_engine, records.INTERVAL, remote.INTERVAL)
"""


def test_a_name_has_its_new_value_also_where_it_was_imported():
    ended = subprocess.run([sys.executable, "-c", PUT], capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["forked", "forked", "7.0", "7.0"]
