# SPDX-License-Identifier: MIT
"""How kernels are compiled, and how their parts run side by side."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

_Kernel = TypeVar("_Kernel", bound=Callable[..., object])
_Result = TypeVar("_Result")


def compiled(kernel: _Kernel) -> _Kernel:
    """Compile a function when it is first called, and keep the result beside its source.

    Arithmetic stays IEEE 754 as written: nothing is reassociated and no product is fused with a sum, on which exact
    predicates rely. The interpreter is released while it runs.
    """
    said: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False}
    try:
        made: Any = numba.njit(cache=True, **said)(kernel)
    except RuntimeError:  # nowhere to keep it: neither beside the source nor in the user's own folder
        made = numba.njit(cache=False, **said)(kernel)
    keep: Any = made._cache.save_overload  # noqa: SLF001 - numba has no other way to be told

    def kept(signature: object, data: object) -> None:
        # Where nothing may be written, as in a guarded child, or no space is left, it is compiled again next time.
        with suppress(OSError):
            keep(signature, data)

    made._cache.save_overload = kept  # noqa: SLF001 - as above
    of_types, plain = made.get_call_template, cast(Callable[[object], object], numba.types.unliteral)

    def of_plain_types(given: tuple[Any, ...], named: dict[str, Any]) -> object:
        return of_types(tuple(map(plain, given)), {name: plain(one) for name, one in named.items()})

    # A kernel called with a number written out is otherwise compiled anew for that number: most of the compiling.
    made.get_call_template = of_plain_types
    return cast(_Kernel, made)


def is_kept(kernel: Callable[..., object]) -> bool:
    """Whether a kernel was compiled before and kept on this machine."""
    made = cast(Any, kernel)
    folder = made.stats.cache_path
    return folder is not None and any(Path(folder).glob(f"*.{made.py_func.__name__}-*.nbi"))


def side_by_side(
    work: Callable[[int, int], _Result], bounds: Iterable[tuple[int, int]], *, threads: int | None = None
) -> Iterator[_Result]:
    """Results of ``work(low, high)`` in the order of ``bounds``, whichever thread is first.

    Parameters
    ----------
    work : callable
        A compiled kernel, or what releases the interpreter.
    bounds : iterable of (low, high)
        Parts; more than threads, so that none waits for long.
    threads : int, optional
        By default one a processor. Results do not depend on it.

    Notes
    -----
    Threads of Python, not of the compiler: its own layers differ by machine, and one of them ends the process when two
    callers meet in it. At most four parts a thread are under way, so that results do not pile up.
    """
    threads = threads or os.cpu_count() or 1
    parts = iter(bounds)
    if threads == 1:
        yield from (work(low, high) for low, high in parts)
        return
    with ThreadPoolExecutor(threads) as pool:
        waiting: list[Future[_Result]] = [pool.submit(work, *part) for part in islice(parts, 4 * threads)]
        try:
            while waiting:
                result = waiting.pop(0).result()
                waiting.extend(pool.submit(work, *part) for part in islice(parts, 1))
                yield result
        finally:
            for future in waiting:
                future.cancel()


def parts_of(n: int, size: int) -> list[tuple[int, int]]:
    """Consecutive parts (low, high) of n rows, at most ``size`` long.

    Examples
    --------
    >>> parts_of(5, 2)
    [(0, 2), (2, 4), (4, 5)]
    """
    return [(low, min(low + size, n)) for low in range(0, n, size)]
