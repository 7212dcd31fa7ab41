# SPDX-License-Identifier: MIT
"""The texts of a rule: one file a rule, ``rules/texts/GEO006.toml``, one table a language.

Each table holds ``title``, ``finding`` (a sentence with fields) and ``mend``. The docstring of the rule is its English
manual; another language translates it as ``manual``, and says in ``translates`` which docstring: its digest.
"""

import hashlib
import tomllib
from collections.abc import Mapping
from functools import cache

from foparq.errors import RuleError
from foparq.resources import shipped


@cache
def rule_texts(code: str) -> Mapping[str, Mapping[str, str]]:
    """Texts of one rule by language and part.

    Parameters
    ----------
    code : str
        ``"TOP021"``.

    Raises
    ------
    RuleError
        If the rule has no file of texts, or the file is not TOML.
    """
    file = shipped("rules") / "texts" / f"{code}.toml"
    try:
        with file.open("rb") as stream:
            return tomllib.load(stream)
    except FileNotFoundError:
        raise RuleError("rule.no-texts", code=code) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise RuleError("rule.texts-broken", code=code, because=str(error)) from error


def rule_text(message: str, language: str) -> str | None:
    """Text of ``"TOP021.finding"`` in one language, or ``None`` if that language does not have it."""
    code, _, part = message.partition(".")
    text = rule_texts(code).get(language, {}).get(part)
    return None if text is None else text.strip()


def has_part(code: str, part: str) -> bool:
    """Whether the texts of a rule hold a part that not every rule has; a rule without texts has none."""
    file = shipped("rules") / "texts" / f"{code}.toml"
    return file.is_file() and any(part in texts for texts in rule_texts(code).values())


def digest(manual: str) -> str:
    """What ``translates`` must say of a translation of this docstring: twelve hexadecimal digits."""
    return hashlib.blake2b(manual.encode(), digest_size=6).hexdigest()
