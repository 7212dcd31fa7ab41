# SPDX-License-Identifier: MIT
"""Load ``findings.gpkg`` into QGIS with its own styles, draw it, and print what came of it as JSON.

Run by the Python that has QGIS: ``/usr/bin/python3 tests/tools/qgis_looks.py findings.gpkg picture.png``.
"""

import json
import sys
from typing import Any

from qgis.core import (  # type: ignore[import-not-found]
    QgsApplication,
    QgsExpression,
    QgsExpressionContext,
    QgsExpressionContextUtils,
    QgsMapRendererParallelJob,
    QgsMapSettings,
    QgsProject,
    QgsRectangle,
    QgsRenderContext,
    QgsVectorLayer,
)  # fmt: skip
from qgis.PyQt.QtCore import QSize  # type: ignore[import-not-found]
from qgis.PyQt.QtGui import QColor  # type: ignore[import-not-found]

ORDER = ("flags_p", "flags_l", "flags_a", "residuals", "features_a", "desenho_l", "desenho_a")


def told(layer: Any) -> dict[str, Any]:
    """What QGIS makes of one layer."""
    _, styled = layer.loadDefaultStyle()
    QgsProject.instance().addMapLayer(layer)
    context = QgsExpressionContext(QgsExpressionContextUtils.globalProjectLayerScopes(layer))
    context.setFields(layer.fields())
    rendering = QgsRenderContext()
    rendering.setExpressionContext(context)
    renderer = layer.renderer()
    renderer.startRender(rendering, layer.fields())
    labels = [QgsExpression(layer.labeling().settings().fieldName)] if layer.labelsEnabled() else []
    tips, errors, drawn = [], [], 0
    for feature in layer.getFeatures():
        context.setFeature(feature)
        rendering.expressionContext().setFeature(feature)
        drawn += renderer.symbolForFeature(feature, rendering) is not None
        tips.append(QgsExpression.replaceExpressionText(layer.mapTipTemplate(), context))
        for label in labels:
            text = label.evaluate(context)
            if label.hasEvalError() or not text:
                errors.append(f"{text}: {label.evalErrorString()}")
    renderer.stopRender(rendering)
    box = layer.extent()
    return {
        "styled": styled, "features": layer.featureCount(), "drawn": drawn, "tips": tips, "errors": errors,
        "width": box.width(), "height": box.height(),
    }  # fmt: skip


def picture(layers: list[Any]) -> Any:
    """Image of some layers over the extent of the drawings."""
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setBackgroundColor(QColor("white"))
    settings.setOutputSize(QSize(1600, 900))
    extent = QgsRectangle()
    for layer in layers:
        extent.combineExtentWith(layer.extent())
    settings.setExtent(extent)
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    return job.renderedImage()


def ink(image: Any) -> int:
    """Pixels that are not white."""
    white = QColor("white").rgb()
    return sum(image.pixel(x, y) != white for x in range(0, image.width(), 2) for y in range(0, image.height(), 2))


def main(package: str, out: str) -> None:
    """Say what QGIS makes of every layer, and draw them all."""
    layers = {name: QgsVectorLayer(f"{package}|layername={name}", name, "ogr") for name in ORDER}
    there = {name: layer for name, layer in layers.items() if layer.isValid()}
    report = {name: told(layer) for name, layer in there.items()}
    for name, layer in there.items():
        report[name]["ink"] = ink(picture([layer])) if report[name]["features"] else 0
    picture(list(there.values())).save(out)
    sys.stdout.write(json.dumps(report))


if __name__ == "__main__":
    application = QgsApplication([], False)
    application.initQgis()
    main(*sys.argv[1:3])
    application.exitQgis()
