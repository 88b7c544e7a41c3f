"""The report: execute the notebooks, assemble one text, render it as HTML and PDF, build the players.

The steps, in the order in which `pontryagin.report.build` takes them:

dependencies    what a notebook or a recording is made of
execute         notebooks to executed notebooks, figures and tables
recordings      the papers' recordings
front, provenance, assemble     one Markdown text
render_html, render_pdf         the text as one page and as a PDF
player          pages that replay the recordings
"""
