#!/bin/sh
# Makes three.min.js: what three-entry.js names of three.js, without the rest, in one file that runs in any page.
# Needs Node and npm. The same versions give the same bytes; three.toml holds their hash, and a test compares it.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm init --yes >/dev/null
npm install --silent --no-audit --no-fund three@0.187.0 esbuild@0.28.2
cp node_modules/three/LICENSE "$here/three-LICENSE.txt"
cp "$here/three-entry.js" entry.js
# The licence asks to go with every copy, and the page is one.
{ echo "/* three.js 0.187.0, the parts that are used here. https://threejs.org"; cat node_modules/three/LICENSE; echo "*/"; } > banner.txt
npx esbuild entry.js --bundle --minify --format=iife --global-name=three --target=es2022 --legal-comments=none \
  --banner:js="$(cat banner.txt)" --charset=utf8 --log-level=error --outfile="$here/three.min.js"
sha256sum "$here/three.min.js"
