# SPDX-License-Identifier: MIT
"""Kernels are compiled before rules run within their bounds, and work where nothing can be kept."""

import os
import subprocess
import sys
from pathlib import Path

#: after warming, no rule on a mesh with every planted fault needs a kernel that is not there
READY = """
import sys
import numpy as np
from tests.mesh.files import Mesh
from tests.mesh.parts import part_of, profile
from tests.mesh.planted import bases, planted
from foparq.check.run import check_part
from foparq.mesh.warm import warm

def compiled():
    return {
        f"{module.__name__}.{name}": len(one.signatures)
        for module in list(sys.modules.values()) if module.__name__.startswith("foparq.mesh.")
        for name, one in vars(module).items() if hasattr(one, "signatures")
    }

warm()
before = compiled()
for name in bases():
    made = planted(name, each=2, seed=0)
    assert not check_part(part_of(made.mesh, closed=made.closed), profile(), 50).log
after = compiled()
late = sorted(name for name in after if after[name] != before.get(name, 0))
assert before and not late, late
"""

#: a process that may write nothing, and finds nothing that was kept
NO_SPACE = """
import resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
import numpy as np
from foparq.mesh.grouping import joined
assert joined(5, np.array([3, 1]), np.array([1, 4])).tolist() == [0, 1, 2, 1, 1]
"""


def ran(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    root = Path(__file__).parents[2]
    return subprocess.run(
        [sys.executable, "-c", code], cwd=root, env={**os.environ, "PYTHONPATH": str(root), **environment},
        capture_output=True, text=True, check=False,
    )  # fmt: skip


def test_no_rule_compiles_anything_of_its_own() -> None:
    done = ran(READY)
    assert done.returncode == 0, done.stderr


def test_what_cannot_be_kept_is_compiled_all_the_same(tmp_path: Path) -> None:
    done = ran(NO_SPACE, NUMBA_CACHE_DIR=str(tmp_path / "kept"))
    assert done.returncode == 0, done.stderr
    assert not list(tmp_path.rglob("*.nbc"))
