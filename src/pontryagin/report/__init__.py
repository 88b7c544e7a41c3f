"""The report: execute the notebooks, assemble one text, render it as HTML and PDF, build the players.

The steps, in the order in which `pontryagin.report.build` takes them:

snapshot        whether anything changed since the last build
dependencies    what a notebook, a recording or a kept result is made of
result_keys, ahead      keys of the results that notebooks share; the dear ones computed beside them
schedule        what there is to do, several at a time, the longest first
execute         notebooks to executed notebooks, figures and tables
recordings      the papers' recordings
front, provenance, assemble     one Markdown text
render_html, render_pdf         the text as one page and as a PDF
player          pages that replay the recordings
"""
